// SPDX-License-Identifier: GPL-3.0-or-later

// The program as its users run it: arguments in, exit code, streams and files out.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "garmentfit/io.h"
#include "garmentfit/mesh.h"
#include "garmentfit/skinned_gltf.h"

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Arguments = std::vector<std::string>;

const std::string k_body = GARMENTFIT_SAMPLES "/walking_woman.ply", k_skirt = GARMENTFIT_SAMPLES "/skirt.ply";

std::string read_text(const fs::path& path)
{
    std::ifstream file(path);
    return { std::istreambuf_iterator<char>(file), {} };
}

/// Keys of a report, at any depth, that a page does not name as `key`. Those of "bones" are names of bones.
std::vector<std::string> keys_without_a_word(const nlohmann::json& report, const std::string& page)
{
    std::vector<std::string> missing;
    for (const auto& [key, value] : report.items()) {
        if (report.is_object() && page.find("`" + key + "`") == std::string::npos)
            missing.push_back(key);
        if (!value.is_structured() || key == "bones")
            continue;
        const std::vector<std::string> below = keys_without_a_word(value, page);
        missing.insert(missing.end(), below.begin(), below.end());
    }
    return missing;
}

struct Ended {
    int code = -1;
    std::string out, err;

    long error_lines() const { return std::count(err.begin(), err.end(), '\n'); }
};

// A program that still loads its libraries has no say in how it ends.
void wait_until_caught(pid_t pid, int signal)
{
    for (int attempt = 0; attempt < 6000; ++attempt) {
        std::ifstream status("/proc/" + std::to_string(pid) + "/status");
        for (std::string line; std::getline(status, line);)
            if (line.rfind("SigCgt:", 0) == 0 && (std::stoull(line.substr(7), nullptr, 16) >> (signal - 1) & 1))
                return;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    FAIL() << "no handler for signal " << signal;
}

class CommandLine : public testing::Test {
protected:
    CommandLine()
    {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder = fs::temp_directory_path() / ("garmentfit_" + std::string(test->name()) + std::to_string(getpid()));
        fs::create_directories(folder);
    }
    ~CommandLine() override { fs::remove_all(folder); }

    pid_t start(const Arguments& arguments) const
    {
        std::vector<char*> argv { const_cast<char*>(GARMENTFIT_PROGRAM) };
        for (const std::string& argument : arguments)
            argv.push_back(const_cast<char*>(argument.c_str()));
        argv.push_back(nullptr);
        posix_spawn_file_actions_t streams;
        posix_spawn_file_actions_init(&streams);
        const int flags = O_WRONLY | O_CREAT | O_TRUNC;
        posix_spawn_file_actions_addopen(&streams, STDOUT_FILENO, (folder / "stdout").c_str(), flags, 0644);
        posix_spawn_file_actions_addopen(&streams, STDERR_FILENO, (folder / "stderr").c_str(), flags, 0644);
        pid_t pid = -1;
        EXPECT_EQ(posix_spawn(&pid, GARMENTFIT_PROGRAM, &streams, nullptr, argv.data(), environ), 0);
        posix_spawn_file_actions_destroy(&streams);
        return pid;
    }

    Ended wait_for(pid_t pid) const
    {
        int status = 0;
        waitpid(pid, &status, 0);
        return { WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), read_text(folder / "stdout"),
                 read_text(folder / "stderr") };
    }

    Ended run(const Arguments& arguments) const { return wait_for(start(arguments)); }

    /// Sends a signal so long after the program can catch it.
    Ended stop(const Arguments& arguments, int signal, std::chrono::duration<double> after) const
    {
        const pid_t pid = start(arguments);
        wait_until_caught(pid, signal);
        std::this_thread::sleep_for(after);
        kill(pid, signal);
        return wait_for(pid);
    }

    std::string write(const std::string& name, const std::string& text) const
    {
        std::ofstream(folder / name) << text;
        return folder / name;
    }

    /// Exit code 2, one line that says `words`, nothing on standard output, no result folder.
    void expect_refused(Arguments arguments, const std::vector<std::string>& words) const
    {
        const fs::path result = folder / "result";
        arguments.insert(arguments.end(), { "-o", result.string() });
        const Ended ended = run(arguments);
        EXPECT_EQ(ended.code, 2) << ended.err;
        EXPECT_EQ(ended.error_lines(), 1) << ended.err;
        EXPECT_EQ(ended.out, "");
        for (const std::string& word : words)
            EXPECT_NE(ended.err.find(word), std::string::npos) << '"' << word << "\" is not in: " << ended.err;
        expect_only_streams_and_inputs();
    }

    /// Nothing but the files of this test: no result folder, no draft of one.
    void expect_only_streams_and_inputs() const
    {
        for (const auto& entry : fs::directory_iterator(folder))
            EXPECT_FALSE(entry.is_directory()) << entry.path() << " was left behind";
    }

    fs::path folder;
};

std::string cube_obj()
{
    return "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
           "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
}

TEST_F(CommandLine, ExplainsItself)
{
    for (const std::string command : { "", "dress", "rig", "fit", "drape", "recover" }) {
        const Ended ended = run(command.empty() ? Arguments { "--help" } : Arguments { command, "--help" });
        EXPECT_EQ(ended.code, 0) << command;
        EXPECT_EQ(ended.err, "");
        EXPECT_NE(ended.out.find("Example"), std::string::npos) << command << ": no example in its help";
    }
    EXPECT_EQ(run({ "--version" }).code, 0);
}

TEST_F(CommandLine, RefusesACallItDoesNotUnderstand)
{
    for (const Arguments& arguments :
         { Arguments {}, { "iron" }, { "dress" }, { "dress", k_body }, { "rig", k_body, "--shiny" } }) {
        const Ended ended = run(arguments);
        EXPECT_EQ(ended.code, 2);
        EXPECT_EQ(ended.error_lines(), 1) << ended.err;
    }
}

TEST_F(CommandLine, RefusesAMissingFile) { expect_refused({ "dress", "nobody.ply", k_skirt }, { "nobody.ply" }); }

TEST_F(CommandLine, TellsProgramsTheCodeOfAnError)
{
    const auto code_of = [&](Arguments call) {
        call.insert(call.end(), { "--json", "-o", folder / "result" });
        const Ended ended = run(call);
        EXPECT_EQ(ended.code, 2);
        EXPECT_EQ(ended.error_lines(), 1);
        const auto error = nlohmann::json::parse(ended.out).at("error");
        EXPECT_NE(ended.err.find(error.at("message").get<std::string>()), std::string::npos) << ended.err;
        return error.at("code").get<std::string>();
    };
    EXPECT_EQ(code_of({ "rig", "nobody.ply" }), "unreadable_file");
    EXPECT_EQ(code_of({ "rig", k_body, "--seed", "1" }), "wrong_call") << "no step draws random numbers";
    EXPECT_EQ(code_of({ "dress", k_body, k_skirt, "--type", "umbrella" }), "unknown_name");
    EXPECT_EQ(code_of({ "dress", k_body, k_skirt, "--density", "7" }), "out_of_range");
    EXPECT_EQ(code_of({ "rig", write("cube.obj", cube_obj()) }), "not_human");
    EXPECT_EQ(code_of({ "rig", write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n") }), "no_faces");
    EXPECT_EQ(code_of({ "drape", folder.string() }), "unreadable_file");
}

TEST_F(CommandLine, RefusesAFolderAsMesh) { expect_refused({ "rig", folder.string() }, { folder.string() }); }

TEST_F(CommandLine, RefusesAMeshWithoutFaces)
{
    expect_refused({ "dress", write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), k_skirt }, { "face" });
}

TEST_F(CommandLine, RefusesNumbersThatAreNotFinite)
{
    expect_refused({ "dress", write("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"), k_skirt }, { "nan.obj" });
}

TEST_F(CommandLine, RefusesAnIndexOutOfRange)
{
    expect_refused({ "dress", write("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"), k_skirt }, { "range.obj" });
}

TEST_F(CommandLine, RefusesACubeAsBody) { expect_refused({ "dress", write("cube.obj", cube_obj()), k_skirt }, {}); }

TEST_F(CommandLine, RefusesAGarmentAsBody) { expect_refused({ "dress", GARMENTFIT_SAMPLES "/coat.ply", k_skirt }, {}); }

TEST_F(CommandLine, RefusesAnUnknownType)
{
    expect_refused({ "dress", k_body, k_skirt, "--type", "umbrella" }, { "umbrella", "tshirt" });
}

TEST_F(CommandLine, RefusesMoreTypesThanGarments)
{
    expect_refused({ "dress", k_body, k_skirt, "--type", "skirt", "--type", "tshirt" }, { "2 types" });
}

TEST_F(CommandLine, RefusesAParameterOutOfRange)
{
    expect_refused({ "rig", k_body, "--proxy-vertices", "3" }, { "proxy_vertices", "3", "1000..50000" });
}

TEST_F(CommandLine, RefusesWhatIsSaidOfGarmentsInAWrongNumberOrRange)
{
    const std::string coat = GARMENTFIT_SAMPLES "/coat.ply";
    const auto refused = [&](const Arguments& more, const std::vector<std::string>& words) {
        Arguments call { "fit", k_body, k_skirt, coat };
        call.insert(call.end(), more.begin(), more.end());
        expect_refused(call, words);
    };
    const std::string front = "--garment-front", scale = "--garment-scale", placed = "--as-placed";
    refused({ front, "+y" }, { "skirt.ply", "garment_front: +y lies along the up axis" });
    refused({ front, "forwards" }, { "unknown axis", "forwards", "-z" });
    refused({ front, "+z", front, "+z", front, "+z" }, { "3 values of --garment-front for 2 garments" });
    refused({ scale, "0" }, { "garment_scale", "0.001..1000" });
    refused({ scale, "large" }, { "garment_scale", "large", "0.001..1000" });
    refused({ scale, "1", scale, "1", scale, "1" }, { "--garment-scale" });
    refused({ placed, placed, placed }, { "--as-placed" });
    refused({ "--height", "20" }, { "height", "0.2..10 m" });
    refused({ "--time-limit", "-1" }, { "time_limit" });
}

TEST_F(CommandLine, RefusesFabricsThatAreNoneOrOfNoGarment)
{
    const std::string coat = GARMENTFIT_SAMPLES "/coat.ply", fabric = "--fabric";
    const auto refused = [&](const Arguments& more, const std::vector<std::string>& words) {
        Arguments call { "dress", k_body, k_skirt, coat };
        call.insert(call.end(), more.begin(), more.end());
        expect_refused(call, words);
    };
    refused({ fabric, "paper" }, { "paper", "cotton", "tulle" });
    refused({ fabric, "shirt.ply=jersey" }, { "no garment has the file name shirt.ply" });
    refused({ fabric, "coat.ply=paper" }, { "paper", "cotton" });
    refused({ fabric, "wool", fabric, "wool", fabric, "wool" }, { "3 values of --fabric for 2 garments" });
}

TEST_F(CommandLine, TellsWhatWasSaidOfEachGarment)
{
    const std::string coat = GARMENTFIT_SAMPLES "/coat.ply";
    const Ended ended
        = run({ "fit", k_body, k_skirt, coat, "--garment-front", "+z", "--garment-scale", "1.1", "--garment-scale", "1",
                "--as-placed=off", "--as-placed=on", "--height", "1.8", "--json", "-o", folder / "fitted" });
    ASSERT_EQ(ended.code, 0) << ended.err;
    const auto report = nlohmann::json::parse(ended.out);
    EXPECT_NEAR(report.at("body").at("height").get<double>(), 1.8, 1e-9);
    const auto& garments = report.at("garments");
    const auto& skirt = garments.at(0).at("given");
    EXPECT_EQ(skirt, (nlohmann::json { { "front", "+z" }, { "as_placed", false }, { "scale", 1.1 } }));
    EXPECT_EQ(garments.at(1).at("given"),
              (nlohmann::json { { "front", "+z" }, { "as_placed", true }, { "scale", 1.0 } }));
    EXPECT_NEAR(garments.at(0).at("guesses").at("metres_per_unit").get<double>(), 1.1, 1e-12)
        << "the skirt keeps its own metres";
    EXPECT_EQ(garments.at(1).at("guesses").at("metres_per_unit"), report.at("body").at("metres_per_unit"))
        << "the coat is of the body's scene";
}

TEST_F(CommandLine, EndsAtItsTimeLimitWithoutFilesWhereThereIsNoState)
{
    const Ended ended = run({ "dress", k_body, k_skirt, "--time-limit", "0.001", "--json", "-o", folder / "result" });
    EXPECT_EQ(ended.code, 4) << ended.err;
    EXPECT_EQ(ended.error_lines(), 1) << ended.err;
    EXPECT_NE(ended.err.find("time_limit: it was reached while rigging the body"), std::string::npos) << ended.err;
    EXPECT_EQ(nlohmann::json::parse(ended.out).at("error").at("code"), "time_limit");
    expect_only_streams_and_inputs();
}

TEST_F(CommandLine, EndsAtItsTimeLimitWithTheLastCleanState)
{
    const fs::path fitted = folder / "fitted", draped = folder / "draped";
    ASSERT_EQ(run({ "fit", k_body, k_skirt, "-o", fitted }).code, 0);
    const Ended ended = run({ "drape", fitted, "--time-limit", "0.001", "--json", "-o", draped });
    EXPECT_EQ(ended.code, 4) << ended.err;
    EXPECT_NE(ended.err.find("the time limit was reached while draping"), std::string::npos) << ended.err;
    const auto report = nlohmann::json::parse(ended.out);
    EXPECT_FALSE(report.at("certified").get<bool>());
    EXPECT_EQ(report.at("time_limit"), (nlohmann::json { { "seconds", 0.001 }, { "reached_in", "drape" } }));
    EXPECT_EQ(report.at("garments").at(0).at("crossings").at("body"), 0);
    EXPECT_NE(read_text(draped / "body.ply").find("NOT certified"), std::string::npos);
}

TEST_F(CommandLine, RefusesTwoGarmentsOfOneName)
{
    expect_refused({ "dress", k_body, k_skirt, k_skirt }, { "skirt.ply" });
}

TEST_F(CommandLine, RefusesAFileAsResultFolder)
{
    const std::string file = write("taken", "precious");
    const Ended ended = run({ "rig", k_body, "-o", file });
    EXPECT_EQ(ended.code, 2);
    EXPECT_EQ(ended.error_lines(), 1) << ended.err;
    EXPECT_EQ(read_text(file), "precious");
}

TEST_F(CommandLine, RefusesToContinueWhatItDidNotWrite)
{
    expect_refused({ "drape", GARMENTFIT_SAMPLES }, { "rig.json" });
    expect_refused({ "recover", GARMENTFIT_SAMPLES }, { "drape" });
    fs::create_directory(folder / "mangled");
    std::ofstream(folder / "mangled" / "rig.json") << "{\"format\": \"garmentfit-rig\", ";
    const Ended ended = run({ "drape", folder / "mangled", "-o", folder / "result" });
    EXPECT_EQ(ended.code, 2);
    EXPECT_EQ(ended.error_lines(), 1) << ended.err;
    EXPECT_FALSE(fs::exists(folder / "result"));
}

TEST_F(CommandLine, KeepsWhatStoodInTheResultFolderWhenItRefuses)
{
    fs::create_directory(folder / "result");
    std::ofstream(folder / "result" / "notes.txt") << "mine";
    EXPECT_EQ(run({ "rig", "nobody.ply", "-o", folder / "result" }).code, 2);
    EXPECT_EQ(read_text(folder / "result" / "notes.txt"), "mine");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "result"), {}), 1);
}

TEST_F(CommandLine, LeavesNothingBehindWhenStopped)
{
    for (const int signal : { SIGINT, SIGTERM }) {
        const Ended ended = stop(
            { "dress", k_body, k_skirt, "--type", "skirt", "--settling-steps", "10000", "-o", folder / "result" },
            signal, 0.2s);  // into the work
        EXPECT_EQ(ended.code, 130) << ended.err;
        EXPECT_EQ(ended.error_lines(), 1) << ended.err;
        EXPECT_EQ(ended.err.find("SIGTERM") != std::string::npos, signal == SIGTERM) << ended.err;
        expect_only_streams_and_inputs();
    }
}

TEST_F(CommandLine, WritesNoOutfitOfAGarmentThatIsTooSmallAndNoneOfAnotherFormat)
{
    const Ended wrong = run({ "dress", k_body, k_skirt, "--outfit", folder / "outfit.fbx", "-o", folder / "result" });
    EXPECT_EQ(wrong.code, 2);
    EXPECT_NE(wrong.err.find(".glb"), std::string::npos) << wrong.err;
    const Ended alone = run({ "dress", k_body, k_skirt, "--hide-covered-skin", "-o", folder / "result" });
    EXPECT_EQ(alone.code, 2);
    EXPECT_NE(alone.err.find("--outfit"), std::string::npos) << alone.err;
    const Ended unknown = run(
        { "dress", k_body, k_skirt, "--outfit", folder / "outfit.glb", "--bones", "nobody", "-o", folder / "result" });
    EXPECT_EQ(unknown.code, 2);
    EXPECT_NE(unknown.err.find("mixamo"), std::string::npos) << unknown.err;
    const Ended many = run({ "dress", k_body, k_skirt, "--outfit", folder / "outfit.glb", "--influences", "nine", "-o",
                             folder / "result" });
    EXPECT_EQ(many.code, 2);
    EXPECT_NE(many.err.find("four or eight"), std::string::npos) << many.err;
    const Ended small = run({ "dress", k_body, k_skirt, "--type", "skirt", "--garment-scale", "0.5", "--outfit",
                              folder / "outfit.glb", "-o", folder / "result" });
    EXPECT_NE(small.code, 0);
    EXPECT_FALSE(fs::exists(folder / "outfit.glb"));
}

/// A pipe that nobody writes to: whoever opens it waits for ever.
fs::path silent_pipe(const fs::path& folder)
{
    const fs::path pipe = folder / "never.json";
    EXPECT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    return pipe;
}

TEST_F(CommandLine, EndsWithinASecondOfASignalWhereItWaitsForEver)
{
    const fs::path pipe = silent_pipe(folder);
    for (const int signal : { SIGINT, SIGTERM }) {
        const Ended ended
            = stop({ "rig", k_body, "--joints", pipe, "-o", folder / "result" }, signal, 0.5s);  // until it waits
        EXPECT_EQ(ended.code, 130) << ended.err;
        EXPECT_EQ(ended.error_lines(), 1) << ended.err;
        EXPECT_EQ(ended.err.find("SIGTERM") != std::string::npos, signal == SIGTERM) << ended.err;
        EXPECT_FALSE(fs::exists(folder / "result"));
    }
}

TEST_F(CommandLine, EndsAfterItsTimeLimitWhereItWaitsForEver)
{
    const Ended ended = run(
        { "rig", k_body, "--joints", silent_pipe(folder), "--time-limit", "0.1", "--json", "-o", folder / "result" });
    EXPECT_EQ(ended.code, 4) << ended.err;
    EXPECT_EQ(nlohmann::json::parse(ended.out).at("error").at("code"), "time_limit") << ended.out;
    EXPECT_FALSE(fs::exists(folder / "result"));
}

TEST_F(CommandLine, RigsABodyIntoAFolderThatExistsAlready)
{
    fs::create_directory(folder / "result");
    std::ofstream(folder / "result" / "notes.txt") << "mine";
    const Ended ended = run({ "rig", k_body, "--json", "-o", folder / "result" });
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(ended.err, "");
    EXPECT_EQ(nlohmann::json::parse(ended.out).at("command"), "rig");
    EXPECT_EQ(nlohmann::json::parse(read_text(folder / "result" / "rig.json")).at("bones").size(), 17u);
    EXPECT_EQ(read_text(folder / "result" / "notes.txt"), "mine");
    EXPECT_EQ(garmentfit::MeshFile::read(folder / "result" / "rigged.ply").positions(),
              garmentfit::MeshFile::read(k_body).positions());
}

TEST_F(CommandLine, WritesTheSameBytesWithAnyNumberOfThreads)
{
    ASSERT_EQ(run({ "rig", k_body, "--threads", "1", "-o", folder / "one" }).code, 0);
    ASSERT_EQ(run({ "rig", k_body, "--threads", "4", "-o", folder / "four" }).code, 0);
    for (const char* file : { "rig.json", "rigged.ply" })
        EXPECT_TRUE(read_text(folder / "one" / file) == read_text(folder / "four" / file)) << file << " differs";
}

/// Joint positions by "bone head" and "bone tail".
std::map<std::string, Eigen::Vector3d> joints_in(const fs::path& rig_json)
{
    std::map<std::string, Eigen::Vector3d> joints;
    const auto rig = nlohmann::json::parse(read_text(rig_json));
    for (const auto& bone : rig.at("bones"))
        for (const char* end : { "head", "tail" }) {
            const auto p = bone.at(end).get<std::array<double, 3>>();
            joints[bone.at("name").get<std::string>() + ' ' + end] = { p[0], p[1], p[2] };
        }
    return joints;
}

TEST_F(CommandLine, WritesTheSkeletonInTheUnitsAndAxesOfTheBody)
{
    const auto body = garmentfit::MeshFile::read(k_body);
    std::ofstream obj(folder / "millimetres_z_up.obj");
    for (const auto& p : body.positions().rowwise())
        obj << "v " << 1000 * p.x() << ' ' << -1000 * p.z() << ' ' << 1000 * p.y() << '\n';
    for (const auto& t : body.triangles().rowwise())
        obj << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
    obj.close();
    ASSERT_EQ(run({ "rig", k_body, "-o", folder / "metres" }).code, 0);
    ASSERT_EQ(run({ "rig", folder / "millimetres_z_up.obj", "-o", folder / "millimetres" }).code, 0);
    const auto metres = joints_in(folder / "metres/rig.json"), millimetres = joints_in(folder / "millimetres/rig.json");
    for (const auto& [name, p] : metres)
        EXPECT_LT((millimetres.at(name) - 1000 * Eigen::Vector3d(p.x(), -p.z(), p.y())).norm(), 50)
            << name << ", mm";  // units and axes, not digits
}

TEST_F(CommandLine, TakesTheUsersRigFromRigJsonOrFromASkinnedGlb)
{
    ASSERT_EQ(run({ "rig", k_body, "-o", folder / "rigged" }).code, 0);
    const auto given = joints_in(folder / "rigged/rig.json");
    for (const char* rig : { "rig.json", "rigged.glb" }) {
        const fs::path fitted = folder / rig / "fitted";
        ASSERT_EQ(
            run({ "fit", k_body, k_skirt, "--type", "skirt", "--rig", folder / "rigged" / rig, "-o", fitted }).code, 0);
        const auto taken = joints_in(fitted / "rig.json");
        for (const auto& [name, p] : given)
            EXPECT_LT((taken.at(name) - p).norm(), 1e-5) << rig << ": " << name;  // a GLB has floats
    }
}

TEST_F(CommandLine, TakesTheSkeletonOfASkinnedBodyUnlessItIsWrongOrIgnored)
{
    ASSERT_EQ(run({ "rig", k_body, "-o", folder / "rigged" }).code, 0);
    const fs::path own = folder / "rigged/rigged.glb";
    const auto rig = [&](const Arguments& more, const std::string& name) {
        Arguments call { "rig" };
        call.insert(call.end(), more.begin(), more.end());
        call.insert(call.end(), { "-o", (folder / name).string() });
        const Ended ended = run(call);
        EXPECT_EQ(ended.code, 0) << ended.err;
        return nlohmann::json::parse(read_text(folder / name / "report.json"));
    };
    EXPECT_EQ(rig({ own.string() }, "own")["body"]["skeleton"], "file");
    const auto given = joints_in(folder / "rigged/rig.json"), taken = joints_in(folder / "own/rig.json");
    for (const auto& [name, p] : given)
        EXPECT_LT((taken.at(name) - p).norm(), 1e-5) << name;  // a GLB has floats
    EXPECT_EQ(rig({ own.string(), "--ignore-skin" }, "ignored")["body"]["skeleton"], "shape");

    std::string bytes = read_text(own);  // hips exchanged
    const std::size_t left = bytes.find("\"lfemur\""), right = bytes.find("\"rfemur\"");
    ASSERT_TRUE(left != std::string::npos && right != std::string::npos);
    bytes[left + 1] = 'r';
    bytes[right + 1] = 'l';
    std::ofstream(folder / "exchanged.glb", std::ios::binary) << bytes;
    const auto exchanged = rig({ (folder / "exchanged.glb").string() }, "exchanged");
    EXPECT_EQ(exchanged["body"]["skeleton"], "shape");
    EXPECT_NE(exchanged["warnings"].dump().find("different sides"), std::string::npos) << exchanged["warnings"];
}

TEST_F(CommandLine, WarnsOfAGivenRigThatIsWrongForTheBody)
{
    ASSERT_EQ(run({ "rig", k_body, "-o", folder / "rigged" }).code, 0);
    const auto warnings_with = [&](const fs::path& rig) {
        const fs::path fitted = folder / rig.stem();
        const Ended ended = run({ "fit", k_body, k_skirt, "--type", "skirt", "--rig", rig, "-o", fitted });
        EXPECT_EQ(ended.code, 0) << ended.err;
        return nlohmann::json::parse(read_text(fitted / "report.json"))["warnings"].dump();
    };
    EXPECT_EQ(warnings_with(folder / "rigged/rigged.glb").find("may be wrong"), std::string::npos);
    std::string bytes = read_text(folder / "rigged/rigged.glb");  // arms exchanged
    const std::size_t left = bytes.find("\"lhumerus\""), right = bytes.find("\"rhumerus\"");
    ASSERT_TRUE(left != std::string::npos && right != std::string::npos);
    bytes[left + 1] = 'r';
    bytes[right + 1] = 'l';
    std::ofstream(folder / "exchanged.glb", std::ios::binary) << bytes;
    EXPECT_NE(warnings_with(folder / "exchanged.glb").find("the skeleton in exchanged.glb may be wrong"),
              std::string::npos);
}

TEST_F(CommandLine, LeavesClothesOfAnAvatarsFileOutOfTheBody)
{
    using namespace garmentfit;
    ASSERT_EQ(run({ "rig", k_body, "-o", folder / "rigged" }).code, 0);
    const ForeignRig rig = read_skinned_gltf(folder / "rigged/rigged.glb");
    const MeshFile body = MeshFile::read(folder / "rigged/rigged.glb");
    const Positions outside = body.positions() + 0.02 * vertex_normals(body.positions(), body.triangles());
    write_skinned_glb(folder / "avatar.glb", rig.skeleton,
                      { { "Body", { body.positions(), body.triangles() }, rig.weights },
                        { "Bodysuit", { outside, body.triangles() }, rig.weights } });
    for (const auto& [wears, faces] :
         { std::pair("keep", 2 * body.triangles().rows()), std::pair("strip", body.triangles().rows()) }) {
        const Ended ended = run({ "rig", folder / "avatar.glb", "--wears", wears, "-o", folder / wears });
        ASSERT_EQ(ended.code, 0) << ended.err;
        const auto report = nlohmann::json::parse(read_text(folder / wears / "report.json"));
        EXPECT_EQ(report["body"]["skeleton"], "file");
        EXPECT_EQ(report["warnings"].dump().find("left out of the body: Bodysuit") != std::string::npos,
                  wears == std::string("strip"));
        const MeshFile rigged = MeshFile::read(folder / wears / "rigged.ply");
        EXPECT_EQ(rigged.triangles().rows(), faces);
        EXPECT_EQ(rigged.positions().rows(), 2 * body.positions().rows());
    }
    for (const char* done : { "rigged", "keep", "strip" })  // a refused call leaves no folder
        fs::remove_all(folder / done);
    expect_refused({ "rig", folder / "avatar.glb", "--wears", "nothing" }, { "give keep or strip" });
    expect_refused({ "dress", k_body, folder / "avatar.glb" }, { "shows a body in clothes (Bodysuit)" });
}

/// Triangles of a size in metres, here and there.
std::string scattered_obj(int faces, double size)
{
    std::string obj, indices;
    for (int i = 0; i < 3 * faces; ++i) {
        const int face = i / 3, corner = i % 3;
        obj += "v " + std::to_string(std::sin(7.0 * face) + size * (corner == 1)) + " "
            + std::to_string(1 + std::sin(11.0 * face) + size * (corner == 2)) + " "
            + std::to_string(std::sin(13.0 * face)) + "\n";
        indices += (corner == 0 ? "f " : " ") + std::to_string(i + 1) + (corner == 2 ? "\n" : "");
    }
    return obj + indices;
}

/// A sheet of quads; place(u, v) says where, u and v from 0 to 1.
template <class Place>
std::string grid_obj(int columns, int rows, const Place& place)
{
    std::string obj;
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) {
            const Eigen::Vector3d p = place(double(c) / (columns - 1), double(r) / (rows - 1));
            obj += "v " + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + "\n";
        }
    for (int r = 0; r + 1 < rows; ++r)
        for (int c = 0; c + 1 < columns; ++c) {
            const int v = r * columns + c + 1;
            obj += "f " + std::to_string(v) + " " + std::to_string(v + 1) + " " + std::to_string(v + columns + 1) + " "
                + std::to_string(v + columns) + "\n";
        }
    return obj;
}

TEST_F(CommandLine, SaysWhyWhatIsNoGarmentCannotBeWorn)
{
    const fs::path rigged = fs::temp_directory_path() / (folder.filename().string() + "_rig");
    ASSERT_EQ(run({ "rig", k_body, "-o", rigged }).code, 0);
    const auto expect = [&](const std::string& garment, const std::string& words) {
        expect_refused({ "fit", k_body, garment, "--rig", rigged / "rig.json" }, { words });
    };
    expect(write("square.obj", grid_obj(20, 20, [](double u, double v) { return Eigen::Vector3d(u, v, 0); })),
           "only one opening");
    expect(write("sock.obj",
                 grid_obj(24, 20,
                          [](double u, double v) {
                              const double radius = 0.05 * std::min(1.0, 4 * v), turn = 6.283185307179586 * u;
                              return Eigen::Vector3d(radius * std::cos(turn), 0.3 * v, radius * std::sin(turn));
                          })),
           "opening");
    expect(write("ten.obj", scattered_obj(10, 1)), "10 triangles");
    expect(write("buttons.obj", scattered_obj(1000, 0.01)), " loose pieces");
    expect(write("nothing.obj", ""), "empty");
    fs::remove_all(rigged);
}

TEST_F(CommandLine, FitsSkirtAndCoatInOnePose)
{
    const Ended ended
        = run({ "fit", k_body, k_skirt, GARMENTFIT_SAMPLES "/coat.ply", "--json", "-o", folder / "fitted" });
    ASSERT_EQ(ended.code, 0) << ended.err;
    const auto report = nlohmann::json::parse(ended.out);
    EXPECT_TRUE(report.at("one_pose").get<bool>());
    EXPECT_TRUE(report.at("conflicts").empty());
    const auto clearance
        = report.at("garments").at(1).at("score").at("bones").at("lhumerus").at("clearance").get<double>();
    EXPECT_TRUE(clearance > 0.5 && clearance <= 1) << clearance;
    const auto garments = nlohmann::json::parse(read_text(folder / "fitted/rig.json")).at("garments");
    EXPECT_EQ(garments.at(0).at("pose").at("rotations"), garments.at(1).at("pose").at("rotations"));
    EXPECT_EQ(garments.at(1).at("fitted").size(), 17u);
    EXPECT_TRUE(garments.at(1).at("angles").contains("lhumerus"));
}

class Slow : public CommandLine { };

TEST_F(Slow, DressesInLayersThatItFindsAndKeepsTheOrderGiven)
{
    const fs::path fitted = folder / "fitted", draped = folder / "draped";
    ASSERT_EQ(
        run({ "fit", k_body, GARMENTFIT_SAMPLES "/coat.ply", k_skirt, "--layer-order", "auto", "-o", fitted }).code, 0);
    const auto rig = nlohmann::json::parse(read_text(fitted / "rig.json"));
    EXPECT_EQ(rig.at("garments").at(0).at("layer"), 1);
    EXPECT_EQ(rig.at("garments").at(1).at("layer"), 0);
    EXPECT_EQ(rig.at("fitted"), rig.at("garments").at(0).at("fitted")) << "the pose of the outermost garment";

    const Ended ended = run({ "drape", fitted, "--settling-steps", "2", "--json", "-o", draped });
    ASSERT_EQ(ended.code, 0) << ended.err;
    const auto report = nlohmann::json::parse(ended.out);
    EXPECT_EQ(report.at("garments").at(0).at("file"), "coat.ply");
    EXPECT_EQ(report.at("garments").at(0).at("layer"), 1);
    const Ended back
        = run({ "recover", draped, "--recovery-settling-steps", "2", "--quality", "draft", "--outfit",
                folder / "outfit.glb", "--hide-covered-skin", "--influences", "eight", "-o", folder / "dressed" });
    ASSERT_EQ(back.code, 0) << back.err;
    EXPECT_NE(read_text(folder / "outfit.glb").find("_COVERED"), std::string::npos);
    EXPECT_NE(read_text(folder / "outfit.glb").find("JOINTS_1"), std::string::npos) << "of the coat";
    const auto whole = garmentfit::MeshFile::read(folder / "dressed" / "body.ply");
    const auto outfit = garmentfit::MeshFile::read(folder / "outfit.glb");
    const Eigen::Index of_body = (outfit.triangles().rowwise().maxCoeff().array() < whole.positions().rows()).count();
    EXPECT_LE(of_body, whole.triangles().rows()) << "one looks far up into a coat";
    const double deepest
        = (outfit.positions().topRows(whole.positions().rows()) - whole.positions()).rowwise().norm().maxCoeff();
    EXPECT_GT(deepest, 0.01) << "skin under the coat is drawn in";
    EXPECT_LT(deepest, 0.065);
    EXPECT_GT(of_body, whole.triangles().rows() / 2);

    fs::remove(draped / "coat.ply");  // as where it is too small
    const Ended without = run({ "recover", draped, "-o", folder / "without" });
    EXPECT_EQ(without.code, 2);
    EXPECT_NE(without.err.find("coat.ply: missing"), std::string::npos) << without.err;
    EXPECT_FALSE(fs::exists(folder / "without"));
}

TEST_F(Slow, WritesAsManyFramesAsAskedForAndNoneStayFromAnEarlierRun)
{
    const fs::path result = folder / "result";
    const auto dress = [&](const Arguments& more) {
        Arguments arguments { "dress", k_body,
                              k_skirt, "--type",
                              "skirt", "--settling-steps",
                              "2",     "--recovery-settling-steps",
                              "2",     "--quality",
                              "draft", "--json",
                              "-o",    result };
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Ended ended = run(arguments);
        EXPECT_EQ(ended.code, 0) << ended.err;
        return nlohmann::json::parse(ended.out);
    };
    EXPECT_EQ(dress({ "--frames", "30" }).at("frames"), (nlohmann::json { { "asked", 30 }, { "written", 30 } }));
    EXPECT_TRUE(fs::exists(result / "frames/skirt_029.ply"));
    EXPECT_FALSE(fs::exists(result / "frames/skirt_030.ply"));
    dress({ "--frames", "1" });
    EXPECT_TRUE(fs::exists(result / "frames/skirt_000.ply"));
    EXPECT_FALSE(fs::exists(result / "frames/skirt_001.ply"));
    std::ofstream(result / "notes.txt") << "mine";
    EXPECT_FALSE(dress({}).contains("frames"));
    EXPECT_FALSE(fs::exists(result / "frames"));
    EXPECT_TRUE(fs::exists(result / "fitted/skirt.ply"));
    EXPECT_EQ(read_text(result / "notes.txt"), "mine");
}

TEST_F(Slow, RemovesNoFolderThatItDidNotWrite)
{
    const fs::path result = folder / "result";
    fs::create_directories(result / "frames");
    std::ofstream(result / "frames/holiday.txt") << "mine";
    std::ofstream(result / "report.json") << "{}";
    ASSERT_EQ(run({ "dress", k_body, k_skirt, "--type", "skirt", "--settling-steps", "2", "--recovery-settling-steps",
                    "2", "--quality", "draft", "-o", result })
                  .code,
              0);
    EXPECT_EQ(read_text(result / "frames/holiday.txt"), "mine");
}

/// Every file under a folder, by its path there.
std::map<std::string, std::string> contents_of(const fs::path& folder)
{
    std::map<std::string, std::string> contents;
    if (fs::exists(folder))
        for (const auto& entry : fs::recursive_directory_iterator(folder))
            if (entry.is_regular_file())
                contents[fs::relative(entry.path(), folder)] = read_text(entry.path());
    return contents;
}

TEST_F(Slow, ChangesAllOrNothingWhereverItIsStopped)
{
    const fs::path result = folder / "result";
    const auto arguments = [&](const char* density) {
        return Arguments { "dress", k_body,
                           k_skirt, "--type",
                           "skirt", "--settling-steps",
                           "2",     "--recovery-settling-steps",
                           "2",     "--quality",
                           "draft", "--density",
                           density, "-o",
                           result };
    };
    const fs::path earlier = folder / "earlier";
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(run(arguments("0.2")).code, 0);
    const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - begin;
    fs::rename(result, earlier);
    std::ofstream(earlier / "notes.txt") << "mine";
    const auto before = contents_of(earlier);
    constexpr int k_stops = 12;
    std::mt19937 random(20);
    int stopped = 0;
    for (int i = 0; i < k_stops; ++i) {
        const bool is_new = i % 2 == 0;
        const int signal = i % 4 < 2 ? SIGINT : SIGTERM;
        const double share
            = (i + random() / double(std::mt19937::max())) / k_stops;  // of the run: one in each part of it
        fs::remove_all(result);
        if (!is_new)
            fs::copy(earlier, result, fs::copy_options::recursive);
        const Ended ended = stop(arguments("0.3"), signal, share * whole);
        const auto after = contents_of(result);
        if (ended.code == 130) {
            ++stopped;
            EXPECT_EQ(ended.error_lines(), 1) << ended.err;
            EXPECT_EQ(fs::exists(result), !is_new);
            EXPECT_TRUE(is_new || after == before) << "stopped after " << share << " of the run";
        } else {  // it was about done
            EXPECT_EQ(ended.code, 0) << ended.err;
            EXPECT_EQ(after.size(), before.size() - (is_new ? 1 : 0));
            EXPECT_TRUE(after != before);
        }
        for (const auto& entry : fs::directory_iterator(folder))
            EXPECT_EQ(entry.path().filename().string().find("unfinished"), std::string::npos) << entry.path();
    }
    EXPECT_GT(stopped, 0);
}

TEST_F(Slow, DressesToTheSameBytesWithAnyNumberOfThreads)
{
    std::map<std::string, std::string> one;
    for (const char* threads : { "1", "2", "8" }) {
        const fs::path result = folder / threads;
        ASSERT_EQ(
            run({ "dress", k_body, k_skirt, "--type", "skirt", "--frames", "3", "--threads", threads, "-o", result })
                .code,
            0);
        auto contents = contents_of(result);
        contents.erase("report.json");  // seconds and memory
        if (one.empty())
            one = contents;
        ASSERT_EQ(contents.size(), one.size());
        for (const auto& [file, bytes] : contents)
            EXPECT_TRUE(bytes == one[file]) << file << " differs with " << threads << " threads";
    }
}

/// The skirt as OBJ with a material and a picture in a folder of its own.
fs::path textured_skirt(const fs::path& folder)
{
    const auto skirt = garmentfit::MeshFile::read(k_skirt);
    fs::create_directories(folder / "tex");
    std::ofstream obj(folder / "skirt.obj");
    obj.precision(9);
    obj << "mtllib skirt.mtl\n";
    for (const auto& row : skirt.positions().rowwise())
        obj << "v " << row << "\nvt " << row[0] << ' ' << row[1] << '\n';
    obj << "usemtl plaid\n";
    for (const auto& row : skirt.triangles().rowwise()) {
        obj << 'f';
        for (const int corner : row)
            obj << ' ' << corner + 1 << '/' << corner + 1;
        obj << '\n';
    }
    std::ofstream(folder / "skirt.mtl") << "newmtl plaid\nmap_Kd tex/plaid.png\nmap_Ke gone.png\n";
    std::ofstream(folder / "tex" / "plaid.png", std::ios::binary) << "\x89PNG\r\n\x1a\n";
    return folder / "skirt.obj";
}

TEST_F(Slow, CarriesMaterialsAndPicturesAlong)
{
    const Ended ended = run({ "dress", k_body, textured_skirt(folder / "given"), "--type", "skirt", "--quality",
                              "draft", "--json", "--outfit", folder / "outfit.vrm", "-o", folder / "dressed" });
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_NE(read_text(folder / "outfit.vrm").find("VRMC_vrm"), std::string::npos) << "by its name";
    for (const char* copy : { "dressed", "dressed/rest", "dressed/fitted" }) {
        EXPECT_TRUE(fs::exists(folder / copy / "skirt.mtl")) << copy;
        EXPECT_TRUE(fs::exists(folder / copy / "tex" / "plaid.png")) << copy;
    }
    EXPECT_NE(ended.out.find("gone.png cannot be read"), std::string::npos) << "a warning";
    const auto look = garmentfit::MeshFile::read(folder / "outfit.vrm").appearance();
    ASSERT_EQ(look.materials.size(), 1u);
    EXPECT_EQ(look.materials[0].name, "plaid");
    EXPECT_EQ(look.pictures.size(), 1u);
}

TEST_F(Slow, LeavesOutSkinUnderAShirtAndDrawsTheRestIn)
{
    const Ended ended = run({ "dress", GARMENTFIT_BODIES "/muscular_man_hands_on_hips.ply",
                              GARMENTFIT_SAMPLES "/shirt.ply", "--quality", "draft", "--outfit", folder / "outfit.glb",
                              "--hide-covered-skin", "-o", folder / "dressed" });
    ASSERT_EQ(ended.code, 0) << ended.err;
    const auto whole = garmentfit::MeshFile::read(folder / "dressed" / "body.ply"),
               outfit = garmentfit::MeshFile::read(folder / "outfit.glb");
    const Eigen::Index of_body = (outfit.triangles().rowwise().maxCoeff().array() < whole.positions().rows()).count();
    EXPECT_LT(of_body, whole.triangles().rows()) << "skin under the shirt is left out";
    EXPECT_GT(of_body, whole.triangles().rows() / 2);
    const double deepest
        = (outfit.positions().topRows(whole.positions().rows()) - whole.positions()).rowwise().norm().maxCoeff();
    EXPECT_GT(deepest, 0.01);
    EXPECT_LT(deepest, 0.065);
}

TEST_F(Slow, KeepsTheFileOfASkinnedBodyInItsOutfit)
{
    ASSERT_EQ(run({ "rig", k_body, "-o", folder / "rigged" }).code, 0);
    const fs::path avatar = folder / "rigged/rigged.glb";
    const Ended ended = run({ "dress", avatar, k_skirt, "--type", "skirt", "--quality", "draft", "--outfit",
                              folder / "outfit.glb", "--hide-covered-skin", "-o", folder / "dressed" });
    ASSERT_EQ(ended.code, 0) << ended.err;
    const auto json_of = [](const fs::path& glb) {
        const std::string bytes = read_text(glb);
        std::uint32_t size = 0;
        std::memcpy(&size, bytes.data() + 12, sizeof size);
        return nlohmann::json::parse(bytes.substr(20, size));
    };
    const auto given = json_of(avatar), outfit = json_of(folder / "outfit.glb");
    ASSERT_EQ(outfit.at("nodes").size(), given.at("nodes").size() + 1);
    for (std::size_t i = 0; i < given.at("nodes").size(); ++i)
        EXPECT_EQ(outfit.at("nodes")[i], given.at("nodes")[i]) << i;
    EXPECT_EQ(outfit.at("nodes").back().at("name"), "skirt");
    EXPECT_TRUE(outfit.at("meshes")[0].at("primitives")[0].at("attributes").contains("_COVERED"));
    const auto worn = garmentfit::MeshFile::read(folder / "dressed" / "skirt.ply"),
               whole = garmentfit::MeshFile::read(folder / "outfit.glb");
    EXPECT_LT((whole.positions().bottomRows(worn.positions().rows()) - worn.positions()).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_F(Slow, DressesTheSampleAndGoesTheSameWayStepByStep)
{
    const fs::path dressed = folder / "dressed", fitted = folder / "fitted", draped = folder / "draped",
                   own = folder / "own";
    const Ended whole = run({ "dress", k_body, k_skirt, "--type", "skirt", "--json", "--outfit",
                              folder / "worn" / "outfit.glb", "-o", dressed });
    ASSERT_EQ(whole.code, 0) << whole.err;
    const auto report = nlohmann::json::parse(whole.out);
    EXPECT_TRUE(report.at("certified").get<bool>());
    EXPECT_EQ(report.at("cloth").at("fabric"), "cotton");
    const auto& crossings = report.at("garments").at(0).at("crossings");
    EXPECT_EQ(crossings.at("body"), 0);
    EXPECT_EQ(crossings.at("self"), 0);
    EXPECT_GT(report.at("garments").at(0).at("min_distance").get<double>(), 0);
    EXPECT_EQ(keys_without_a_word(report, read_text(GARMENTFIT_DOCS "/report.md")), std::vector<std::string>());

    const auto body = garmentfit::MeshFile::read(k_body), came_back = garmentfit::MeshFile::read(dressed / "body.ply");
    EXPECT_EQ(came_back.positions(), body.positions()) << "the body moved";
    const auto given = garmentfit::MeshFile::read(k_skirt), worn = garmentfit::MeshFile::read(dressed / "skirt.ply");
    EXPECT_EQ(worn.triangles(), given.triangles());
    EXPECT_TRUE(fs::exists(dressed / "fitted" / "skirt.ply"));
    const auto outfit = garmentfit::MeshFile::read(folder / "worn" / "outfit.glb");
    ASSERT_EQ(outfit.positions().rows(), body.positions().rows() + worn.positions().rows());
    EXPECT_EQ(outfit.triangles().rows(), body.triangles().rows() + worn.triangles().rows());
    const garmentfit::Positions skirt_of_outfit = outfit.positions().bottomRows(worn.positions().rows());
    EXPECT_LT((skirt_of_outfit - worn.positions()).cwiseAbs().maxCoeff(), 1e-6) << "metres, like the input";

    ASSERT_EQ(run({ "fit", k_body, k_skirt, "--type", "skirt", "-o", fitted }).code, 0);
    ASSERT_EQ(run({ "drape", fitted, "-o", draped }).code, 0);
    const Ended heavy = run({ "drape", fitted, "--fabric", "denim", "--density", "0.5", "--json", "--settling-steps",
                              "2", "-o", folder / "denim" });
    ASSERT_EQ(heavy.code, 0) << heavy.err;
    const auto cloth = nlohmann::json::parse(heavy.out).at("cloth");
    EXPECT_EQ(cloth.at("fabric"), "denim");
    EXPECT_EQ(cloth.at("density"), 0.5);
    EXPECT_EQ(cloth.at("stretch_stiffness"), 800);
    const Ended named = run({ "drape", fitted, "--fabric", "wool", "--fabric", "skirt.ply=rib", "--json",
                              "--settling-steps", "2", "-o", folder / "rib" });
    ASSERT_EQ(named.code, 0) << named.err;
    const auto skirt = nlohmann::json::parse(named.out).at("garments").at(0);
    EXPECT_EQ(skirt.at("cloth").at("weft_to_warp"), 0.4);
    EXPECT_EQ(skirt.at("warp_known"), false);
    EXPECT_EQ(skirt.at("cloth").at("fabric"), "rib");
    EXPECT_EQ(skirt.at("cloth").at("largest_stretch"), 0.5);
    EXPECT_NE(skirt.at("verdict").at("fit"), "too small");
    EXPECT_FALSE(skirt.at("verdict").at("places").empty());
    ASSERT_EQ(run({ "recover", draped, "-o", own }).code, 0);
    EXPECT_EQ(garmentfit::MeshFile::read(own / "body.ply").positions(), body.positions());
    const garmentfit::Positions stepwise = garmentfit::MeshFile::read(own / "skirt.ply").positions();
    const double apart = (stepwise - worn.positions()).rowwise().norm().maxCoeff();
    EXPECT_LT(apart, 0.02) << "metres; files between the steps round, and contact is sensitive to it";
}

TEST_F(Slow, PressesTheSkinOfABodyThatCrossesItselfWhereItMay)
{
    const std::string man = GARMENTFIT_BODIES "/heavy_man_arms_down.ply", vest = GARMENTFIT_GARMENTS "/vest.ply";
    const fs::path fitted = folder / "fitted", draped = folder / "draped", dressed = folder / "dressed";
    ASSERT_EQ(run({ "fit", man, vest, "-o", fitted }).code, 0);
    ASSERT_EQ(run({ "drape", fitted, "-o", draped }).code, 0);
    const Ended pressed = run({ "recover", draped, "--press", "0.08", "--quality", "draft", "--json", "-o", dressed });
    ASSERT_EQ(pressed.code, 0) << pressed.err;
    const auto report = nlohmann::json::parse(pressed.out);
    EXPECT_EQ(report.at("pressed_body"), "pressed_body.ply");
    ASSERT_FALSE(report.at("held_back").empty());
    const double deepest = report.at("held_back").at(0).at("distance").get<double>();
    EXPECT_LE(deepest, 0.08);

    const garmentfit::Positions given = garmentfit::MeshFile::read(man).positions();
    EXPECT_EQ(garmentfit::MeshFile::read(dressed / "body.ply").positions(), given);
    const auto skin = garmentfit::MeshFile::read(dressed / "pressed_body.ply");
    EXPECT_NEAR((skin.positions() - given).rowwise().norm().maxCoeff(), deepest, 1e-6);
    EXPECT_NE(read_text(dressed / "pressed_body.ply").find("garmentfit: certified"), std::string::npos);

    const Ended held = run({ "recover", draped, "--quality", "draft", "-o", dressed });
    EXPECT_EQ(held.code, 4);
    EXPECT_NE(held.err.find("m as press"), std::string::npos) << held.err;
    EXPECT_FALSE(fs::exists(dressed / "pressed_body.ply")) << "of the run before";
}

TEST_F(Slow, SaysWhereAGarmentIsTooSmallAndMarksTheStateItLeaves)
{
    const auto skirt = garmentfit::MeshFile::read(k_skirt);
    garmentfit::Positions slimmer = skirt.positions();
    slimmer.col(0) *= 0.65;
    slimmer.col(2) *= 0.65;
    skirt.write(folder / "tight.ply", slimmer);
    const Ended ended
        = run({ "dress", k_body, folder / "tight.ply", "--type", "skirt", "--json", "-o", folder / "result" });
    ASSERT_EQ(ended.code, 3) << ended.err;
    const auto report = nlohmann::json::parse(ended.out);
    EXPECT_FALSE(report.at("certified").get<bool>());
    EXPECT_LT(report.at("scale_reached").get<double>(), 1);
    EXPECT_TRUE(report.at("settled").is_null() && report.at("speed").is_null()) << "it never settled";
    const auto& tight = report.at("garments").at(0).at("too_tight");
    ASSERT_FALSE(tight.empty());
    EXPECT_GT(tight.at(0).at("missing_girth").get<double>(), 0);
    EXPECT_NE(ended.err.find("tight.ply is too small"), std::string::npos) << ended.err;
    EXPECT_EQ(ended.err.find("100%"), std::string::npos) << ended.err;
    EXPECT_NE(read_text(folder / "result" / "body.ply").find("NOT certified"), std::string::npos);
}

}  // namespace
