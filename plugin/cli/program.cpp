// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <oneapi/tbb/global_control.h>
#include <unistd.h>

#include "command_line.h"
#include "garmentfit/error.h"
#include "garmentfit/filters/outcome.h"
#include "garmentfit/filters/rig_file.h"
#include "interruption.h"
#include "output_folder.h"
#include "progress_bar.h"
#include "report.h"
#include "results.h"
#include "session.h"

namespace garmentfit::cli {
namespace {

// Exit codes (docs/command-line.md). derived: 130 is what shells give to a program stopped by Ctrl+C, 128 + SIGINT.
constexpr int k_wrong_input = 2, k_not_certified = 4, k_stopped = 130;

/// What the user says about the body's front, joints and rig.
void read_rig_hints(Call& call, Session& session)
{
    const Frame& frame = session.body.frame.frame;
    call.parameters.rig.front = front_of_body(frame, call.front);
    if (!call.joints.empty())
        call.parameters.rig.joints = read_joints(call.joints, frame);
    if (!call.rig.empty() && !read_rig(session, call.rig))
        call.parameters.rig.joints = read_joints(call.rig, frame);
    if (call.rig.empty() && call.joints.empty() && !call.parameters.rig.front && !call.parameters.rig.swap_sides
        && !call.ignores_skin && !call.reconstruct)
        read_own_skeleton(session);
}

Session read(Call& call)
{
    Session session;
    if (call.filter->name == "drape") {
        read_fitted(session, call.from);
    } else if (call.filter->name == "recover") {
        read_draped(session, call.from);
    } else {
        read_body(session, call.body, { call.body_frame, call.parameters.body_sizes.height },
                  { call.reconstruct, call.wears });
        read_rig_hints(call, session);
        for (std::size_t i = 0; i < call.garments.size(); ++i)
            add_garment(session, call.garments[i],
                        i < call.types.size() ? garment_type_of(call.types[i]) : GarmentType::automatic,
                        call.garment_choice(i));
    }
    const std::vector<std::optional<Fabric>> fabrics = call.fabrics_of(session.garment_names());
    for (std::size_t i = 0; i < fabrics.size(); ++i)
        session.scene.garments[i].fabric = fabrics[i];
    return session;
}

/// Which filters to run: a rig that was read is not computed again.
std::vector<Filter> filters_for(const Call& call, const Session& session)
{
    if (call.filter->name == "fit" && !session.scene.rig)
        return { filter_of("rig"), filter_of("fit") };
    if (call.filter->name == "dress" && session.scene.rig)
        return { call.filter->on_known_rig() };
    if (call.filter->name == "rig" && session.scene.rig)
        return {};
    return { *call.filter };
}

/// Runs a filter. Where the shape is refused after the file's own skeleton was, both reasons are told.
void run_filter(const Filter& filter, const Parameters& parameters, Session& session, const Progress& progress)
{
    try {
        filter.run(session.scene, parameters, progress);
    } catch (const InvalidInput& error) {
        if (session.scene.rig || session.skeleton_refusal.empty())
            throw;
        throw InvalidInput(error.code(),
                           std::string(error.what())
                               + "; nor is the skeleton in its file used: " + session.skeleton_refusal);
    }
}

void compute(const Call& call, Session& session, const Deadline& deadline)
{
    ProgressBar bar(isatty(STDERR_FILENO) && !call.quiet);
    const Progress progress = bar.progress().until(deadline);
    const std::vector<Filter> filters = filters_for(call, session);
    Parameters parameters = call.parameters;
    parameters.recover.cloth = call.filter->cloth(parameters);
    for (std::size_t i = 0; i < filters.size(); ++i) {
        const double n = double(filters.size());
        run_filter(filters[i], parameters, session, progress.part(double(i) / n, double(i + 1) / n));
    }
}

/// A run that writes into the folder that it reads keeps what is there.
std::vector<std::string> outdated(const Call& call, const Session& session, const OutputFolder& folder)
{
    std::error_code none;
    if (!call.from.empty() && std::filesystem::equivalent(call.from, folder.place(), none))
        return {};
    return outdated_results(session, call.filter->name, folder.place());
}

void write(const Call& call, Session& session, OutputFolder& folder)
{
    const auto start = std::chrono::steady_clock::now();
    OutfitRequest outfit = call.outfit;
    if (!outfit.path.empty()) {
        if (!outfit.bones && !call.ignores_skin)
            outfit.avatar = avatar_in(session.body.file, session.body.frame.frame);
        outfit.is_stripped = session.body.only_body.has_value();
        if (!is_on_avatar(outfit))  // else its file is kept as it is
            read_body_look(session);
        read_garment_looks(session);
    }
    write_results(session, call.filter->name, folder.draft());
    add_warnings(session);  // after write_results, which certifies what it wrote
    session.write_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const std::string report = report_json(call, session);
    std::ofstream file(folder.draft() / "report.json");
    if (!(file << report << std::flush))
        throw InvalidInput(ErrorCode::unwritable_file,
                           (folder.place() / "report.json").string()
                               + ": cannot be written; check the space left on the disk");
    file.close();
    stop_if_interrupted();
    stop_watching();
    folder.publish(outdated(call, session, folder));
    const Dressing* end = final_dressing(session.scene);
    if (!outfit.path.empty() && end && end->certified)
        write_outfit(session, outfit);
    if (call.json)
        std::cout << report;
    else if (!call.quiet)
        std::cout << summary(call, session);
}

/// The folder that a forced end abandons, from a thread of its own.
class Abandonable {
public:
    explicit Abandonable(const OutputFolder& folder) { set(&folder); }
    ~Abandonable() { set(nullptr); }
    Abandonable(const Abandonable&) = delete;
    Abandonable& operator=(const Abandonable&) = delete;

    static void abandon()
    {
        const std::lock_guard lock(mutex_);
        if (folder_)
            folder_->abandon();
    }

private:
    static void set(const OutputFolder* folder)
    {
        const std::lock_guard lock(mutex_);
        folder_ = folder;
    }

    static inline std::mutex mutex_;
    static inline const OutputFolder* folder_ = nullptr;
};

int run(int argc, char** argv)
{
    // Who installed this program alone has to learn where the command is.
    if (argc > 1 && std::string_view(argv[1]) == "catalogue")
        throw InvalidInput(ErrorCode::wrong_call,
                           "catalogue is a command of the Python package; install it with: "
                           "pip install 'garmentfit[catalogue]'");
    std::optional<Call> call = parse(argc, argv);
    if (!call)
        return 0;
    std::optional<tbb::global_control> threads;
    if (call->threads > 0)
        threads.emplace(tbb::global_control::max_allowed_parallelism, call->threads);
    const Deadline deadline = Deadline::in(call->parameters.time_limit);
    watch_time_limit(call->parameters.time_limit);
    OutputFolder folder(call->out);
    const Abandonable abandonable(folder);
    Session session = read(*call);
    stop_if_interrupted();
    compute(*call, session, deadline);
    write(*call, session, folder);
    const Dressing* end = final_dressing(session.scene);
    if (!end || end->certified)
        return 0;
    std::cerr << "garmentfit: " << explain(*end, session.garment_names()) << '\n';
    return static_cast<int>(outcome_of(*end));
}

/// Also where the call could not be understood.
bool asks_for_json(int argc, char** argv)
{
    return std::any_of(argv, argv + argc, [](const char* word) { return std::string_view(word) == "--json"; });
}

/// One line for people; for programs, its code too.
int tell_failure(int exit_code, std::string_view code, const std::string& message, bool json)
{
    std::cerr << "garmentfit: " << message << '\n';
    if (json)
        std::cout << error_json(code, message) << std::flush;
    return exit_code;
}

/// Of work that ends by itself.
int fail(int exit_code, std::string_view code, const std::string& message, bool json)
{
    stop_watching();
    return tell_failure(exit_code, code, message, json);
}

/// What the program says where it had to be ended. Leaves no draft of results behind.
void end_at_once(ForcedEnd why, bool json)
{
    Abandonable::abandon();
    const int code = why == ForcedEnd::stopped
        ? tell_failure(k_stopped, "cancelled", interruption_text(), json)
        : tell_failure(
            k_not_certified, "time_limit",
            "time_limit: it was reached in a step that could not end by itself; repair or simplify the meshes, or "
            "give more time, or 0 for no limit",
            json);
    std::_Exit(code);
}

}  // namespace

int run_program(int argc, char** argv)
{
    const bool json = asks_for_json(argc, argv);
    watch_interruption([json](ForcedEnd why) { end_at_once(why, json); });
    try {
        const int code = run(argc, argv);
        stop_watching();
        return code;
    } catch (const Cancelled&) {
        return fail(k_stopped, "cancelled", interruption_text(), json);
    } catch (const TimeLimitReached& error) {
        return fail(k_not_certified, "time_limit", error.what(), json);
    } catch (const InvalidInput& error) {
        return fail(k_wrong_input, name_of(error.code()), error.what(), json);
    } catch (const std::filesystem::filesystem_error& error) {
        return fail(k_wrong_input, name_of(ErrorCode::unwritable_file), error.what(), json);
    } catch (const SolverFailure& error) {
        return fail(k_not_certified, "solver_failure", error.what(), json);
    } catch (const std::bad_alloc&) {
        return fail(k_not_certified, "out_of_memory", "out of memory; give meshes with fewer vertices", json);
    } catch (const std::exception& error) {
        return fail(k_not_certified, "internal_error", error.what(), json);
    }
}

}  // namespace garmentfit::cli
