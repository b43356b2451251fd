// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the inputs that fuzzing begins with, a folder for each target: write_seeds FOLDER
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "fixtures.h"
#include "garmentfit/skinned_gltf.h"
#include "mesh_file_samples.h"
#include "packed_gltf_samples.h"

namespace {

using namespace garmentfit;

void save(const std::filesystem::path& path, const std::string& bytes)
{
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << bytes;
}

void write_packed(const std::filesystem::path& folder)
{
    save(folder / "draco", '\0' + samples::PackedGltf::draco_square());
    samples::PackedGltf packed;
    packed.pack_with_meshopt();
    save(folder / "vertices", '\1' + packed.meshopt_bytes[0]);
    save(folder / "indices", '\2' + packed.meshopt_bytes[1]);
}

std::string edit(int kind, int axis, int row, float value)
{
    return samples::raw(std::uint8_t(kind)) + samples::raw(std::uint8_t(axis)) + samples::raw(std::uint16_t(row))
        + samples::raw(value);
}

/// As given; with one edit of each kind of the body; and with all of them of the garment.
void write_edits(const std::filesystem::path& folder)
{
    for (const int shape : { 0, 1, 2, 3, 4, 224, 240 })  // the last two also search ways of wearing, figures
        save(folder / ("shape" + std::to_string(shape)), std::string(1, char(shape)));
    std::string of_garment(1, '\0');
    for (int kind = 0; kind < 10; ++kind) {
        const auto edited
            = [&](int first) { return edit(first + kind, kind % 3, 97 * kind, 0.5F + 0.1F * float(kind)); };
        save(folder / ("edit" + std::to_string(kind)), std::string(1, char(kind % 4)) + edited(0));
        of_garment += edited(200);
    }
    save(folder / "garment", of_garment);
}

/// A person of few vertices with joints and weights.
void write_avatar(const std::filesystem::path& path)
{
    fixtures::PersonOptions options;
    options.spacing = 0.1;
    const fixtures::Person person = fixtures::capsule_person(options);
    std::filesystem::create_directories(path.parent_path());
    write_skinned_glb(path, person.mesh, fixtures::simple_rig(person));
}

}  // namespace

int main(int count, char** arguments)
{
    if (count != 2) {
        std::fprintf(stderr, "write_seeds: give a folder\n");
        return 2;
    }
    const std::filesystem::path folder = arguments[1];
    for (const samples::File& file : samples::all()) {
        const std::string format = std::filesystem::path(file.name).extension().string().substr(1);
        save(folder / format / file.name, file.bytes);
    }
    save(folder / "gltf" / "square", samples::gltf_json("") + '\0' + samples::gltf_buffer());
    write_avatar(folder / "glb" / "avatar.glb");
    write_packed(folder / "packed");
    write_edits(folder / "rig_fit");
}
