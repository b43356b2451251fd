// SPDX-License-Identifier: GPL-3.0-or-later

// Looks for holes where covered skin was left out: `seen_holes BODY GARMENT WORN [PIXELS [PICTURE]]`, in metres. WORN
// is the dressed garment of `garmentfit dress`. The body is drawn in under the cloth. 1,008 views: each of the 36 poses
// from 28 directions. Prints a line of JSON: pixels that show skin; of these, those that show nothing or the inner side
// of the skin once covered skin is left out, and those that show cloth far behind it; and seconds of CPU time that it
// took to find covered skin. With PICTURE, a PPM file, draws the view with most of them: skin, cloth, and what is seen in
// place of skin in red (through) and yellow (deep). scripts/measure-outfits --holes makes the table.

#include <ctime>
#include <fstream>
#include <iostream>
#include <string>

#include <nlohmann/json.hpp>

#include "garmentfit/covered_skin.h"
#include "garmentfit/garment_weights.h"
#include "garmentfit/inset_skin.h"
#include "garmentfit/io.h"
#include "garmentfit/rig_body.h"
#include "keyframes.h"
#include "views.h"

namespace {

using namespace garmentfit;
using Json = nlohmann::ordered_json;

constexpr int k_views_of_a_pose = 28;

void draw(const fixtures::Worn& worn, const Vec3& direction, int pixels, const std::string& picture)
{
    const auto [whole, shown] = fixtures::views_of(worn, direction, pixels);
    std::ofstream file(picture, std::ios::binary);
    file << "P6\n" << pixels << ' ' << pixels << "\n255\n";
    for (std::size_t p = 0; p < whole.seen.size(); ++p) {
        using fixtures::Seen;
        const bool was_skin = whole.seen[p] == Seen::skin, is_deep = shown.depths[p] > whole.depths[p] + 0.03;
        const char* colour = shown.seen[p] == Seen::nothing ? (was_skin ? "\xFF\0\0" : "\xFF\xFF\xFF")
            : shown.seen[p] == Seen::inside_of_skin         ? (was_skin ? "\xFF\0\0" : "\x60\x40\x40")
            : shown.seen[p] == Seen::skin                   ? "\xD0\xA0\x80"
            : was_skin && is_deep                           ? "\xFF\xE0\0"
                                                            : "\x60\x80\xB0";
        file.write(colour, 3);
    }
}

Json measure(char** files, int pixels, const std::string& picture)
{
    const MeshFile skin = MeshFile::read(files[1]), given = MeshFile::read(files[2]), worn = MeshFile::read(files[3]);
    const TriangleMesh body { skin.positions(), skin.triangles() };
    const Rig rig = rig_body(make_body(body.positions, body.triangles));
    const GarmentMesh garment = make_garment(given.positions(), given.triangles());
    const SkinWeights weights = garment_weights(body, rig.weights, garment, worn.positions());
    const std::clock_t start = std::clock();
    const TriangleMesh inset { inset_skin(body, { { worn.positions(), garment.triangles } }), body.triangles };
    const auto is_covered = find_covered_skin(inset, rig, { { { worn.positions(), garment.triangles }, weights } });
    const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
    const Triangles shown = uncovered_faces(body.triangles, is_covered);

    const std::vector<Keyframe> keys = keyframes_of(rig);
    const int views = int(keys.size()) * k_views_of_a_pose;
    fixtures::Holes all;
    Json worst;
    long most = -1, most_of_views = 0;
    for (std::size_t key = 0; key < keys.size(); ++key) {
        const BoneTransforms transforms = bone_transforms(rig.skeleton, keys[key].pose);
        const fixtures::Worn posed { blend_linearly(inset.positions, rig.weights, transforms),
                                     blend_linearly(worn.positions(), weights, transforms), body.triangles, shown,
                                     garment.triangles };
        fixtures::Holes here;
        for (int view = 0; view < k_views_of_a_pose; ++view) {  // other directions in each pose
            const Vec3 direction = fixtures::direction_of(view * int(keys.size()) + int(key), views);
            const fixtures::Holes holes = holes_seen(posed, direction, pixels);
            here += holes;
            if (!picture.empty() && holes.through + holes.deep > most_of_views) {
                most_of_views = holes.through + holes.deep;
                draw(posed, direction, pixels, picture);
            }
        }
        all += here;
        if (here.through + here.deep > most) {
            most = here.through + here.deep;
            worst = { { "pose", keys[key].name }, { "through", here.through }, { "deep", here.deep } };
        }
    }
    return { { "views", views },
             { "faces", body.triangles.rows() },
             { "shown_faces", shown.rows() },
             { "skin", all.skin },
             { "through", all.through },
             { "deep", all.deep },
             { "worst", worst },
             { "seconds", seconds } };
}

}  // namespace

int main(int count, char** arguments)
try {
    if (count < 4 || count > 6) {
        std::cerr << "usage: seen_holes BODY GARMENT WORN [PIXELS [PICTURE]]\n";
        return 2;
    }
    std::cout << measure(arguments, count > 4 ? std::stoi(arguments[4]) : 300, count > 5 ? arguments[5] : "").dump()
              << "\n";
} catch (const std::exception& error) {
    std::cerr << "seen_holes: " << error.what() << "\n";
    return 2;
}
