// The whole program on real descriptions. What the solver computes is judged in tests/solver; here: what the user
// meets.

#include <algorithm>
#include <csignal>
#include <fstream>
#include <map>
#include <regex>

#include <catch2/catch.hpp>

#include "process.hpp"

using namespace sky::test;
using Catch::Contains;

namespace {

const std::string earth = std::string(SKY_SOURCE_DIR) + "/examples/earth-small.atmo";

std::string contentOf(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// All files below a directory, by relative path.
std::map<std::string, std::string> filesOf(const std::filesystem::path& directory)
{
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(directory))
        if (entry.is_regular_file())
            files[entry.path().lexically_relative(directory).string()] = contentOf(entry.path());
    return files;
}

struct Program {
    TemporaryDirectory directory;

    Outcome calcmysky(std::vector<std::string> arguments, Run run = {}) const
    {
        arguments.insert(arguments.begin(), CALCMYSKY);
        run.arguments = std::move(arguments);
        run.directory = directory.path();
        // Neither display server may be needed.
        run.environment.insert(run.environment.end(), {"DISPLAY", "WAYLAND_DISPLAY"});
        return sky::test::run(run);
    }
    /// Names in the working directory, hidden ones too.
    std::vector<std::string> entries() const
    {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(directory.path()))
            names.push_back(entry.path().filename().string());
        std::sort(names.begin(), names.end());
        return names;
    }
    bool hasOpenGl() const
    {
        const bool found = calcmysky({"doctor"}).exitCode == 0;
        if (!found)
            WARN("skipped: no OpenGL 4.3 here; see calcmysky doctor");
        return found;
    }
    void computeModel(const std::string& name, std::vector<std::string> more = {"--only", "moments"}) const
    {
        more.insert(more.begin(), {earth, "--out-dir", name, "--quality", "draft"});
        const Outcome outcome = calcmysky(more);
        INFO(outcome.output << outcome.error);
        REQUIRE(outcome.exitCode == 0);
    }
};

} // namespace

TEST_CASE_METHOD(Program, "a plan needs neither OpenGL nor a directory")
{
    const Outcome outcome = calcmysky({earth, "--dry-run", "--gl", "osmesa"});
    INFO(outcome.error);
    CHECK(outcome.exitCode == 0);
    CHECK_THAT(outcome.output, Contains("moments") && Contains("computed") && Contains("total"));
    CHECK_THAT(calcmysky({earth, "--dry-run", "--skip", "multiple"}).output, Contains("skipped"));
    CHECK(entries().empty());
}

TEST_CASE_METHOD(Program, "two runs give the same bytes", "[gl]")
{
    if (!hasOpenGl())
        return;
    computeModel("a");
    computeModel("b");
    const auto a = filesOf(directory.path() / "a");
    CHECK(a.contains("manifest.json"));
    CHECK(a == filesOf(directory.path() / "b"));
    CHECK(entries() == std::vector<std::string>{"a", "b"});
}

TEST_CASE_METHOD(Program, "a description from standard input gives the same tables", "[gl]")
{
    if (!hasOpenGl())
        return;
    computeModel("a");
    Run piped;
    piped.input = contentOf(earth);
    piped.directory = directory.path();
    std::filesystem::create_directory_symlink(std::string(SKY_SOURCE_DIR) + "/examples/spectra", directory.path() / "spectra");
    const Outcome outcome = calcmysky({"-", "--out-dir", "b", "--quality", "draft", "--only", "moments"}, piped);
    INFO(outcome.error);
    REQUIRE(outcome.exitCode == 0);
    CHECK(contentOf(directory.path() / "a/moments.exr") == contentOf(directory.path() / "b/moments.exr"));
}

TEST_CASE_METHOD(Program, "errors leave the old model as it was", "[gl]")
{
    if (!hasOpenGl())
        return;
    computeModel("model");
    const auto old = filesOf(directory.path() / "model");
    const auto fails = [&](const std::string& description, int exitCode, const std::string& message) {
        const Outcome outcome = calcmysky({description, "--out-dir", "model"});
        CHECK(outcome.exitCode == exitCode);
        CHECK_THAT(outcome.error, Contains(message));
        CHECK(filesOf(directory.path() / "model") == old);
    };
    directory.file("typo.atmo", "version: 6\natmosphere hieght: 100 km\n");
    fails("typo.atmo", 2, "typo.atmo:2:1: ");
    std::string code = contentOf(earth);
    // Break the first code block: what follows its opening fence no longer compiles.
    const std::size_t block = code.find('\n', code.find("```")) + 1;
    code.insert(block, "this is no GLSL;\n");
    const auto line = std::to_string(std::count(code.begin(), code.begin() + static_cast<std::ptrdiff_t>(block), '\n') + 1);
    std::filesystem::create_directory_symlink(std::string(SKY_SOURCE_DIR) + "/examples/spectra", directory.path() / "spectra");
    directory.file("code.atmo", code);
    fails("code.atmo", 2, "code.atmo:" + line);
    CHECK(calcmysky({"code.atmo", "--validate"}).exitCode == 2);
    CHECK(calcmysky({earth, "--validate"}).exitCode == 0);
}

TEST_CASE_METHOD(Program, "Ctrl-C leaves neither debris nor half a model", "[gl]")
{
    if (!hasOpenGl())
        return;
    Run stop;
    stop.signalAfter = " %  ";
    stop.signal = SIGINT;
    const Outcome outcome = calcmysky({earth, "--out-dir", "model", "--quality", "fine"}, stop);
    INFO(outcome.error);
    CHECK(outcome.exitCode == 130);
    CHECK(entries().empty());
}

TEST_CASE_METHOD(Program, "a killed run leaves the old model whole, and the next run removes what it left", "[gl]")
{
    if (!hasOpenGl())
        return;
    computeModel("model");
    const auto old = filesOf(directory.path() / "model");
    Run stop;
    stop.signalAfter = " %  ";
    stop.signal = SIGKILL;
    CHECK(calcmysky({earth, "--out-dir", "model", "--quality", "fine"}, stop).exitCode == -1);
    CHECK(filesOf(directory.path() / "model") == old);
    computeModel("model");
    CHECK(entries() == std::vector<std::string>{"model"});
}

TEST_CASE_METHOD(Program, "the program runs from wherever it is copied to", "[gl]")
{
    std::filesystem::copy_file(CALCMYSKY, directory.path() / "moved");
    Run moved;
    moved.arguments = {(directory.path() / "moved").string(), "--version"};
    CHECK(run(moved).exitCode == 0);
    if (!hasOpenGl())
        return;
    moved.arguments = {(directory.path() / "moved").string(), earth, "--validate"};
    CHECK(run(moved).exitCode == 0);
}

TEST_CASE_METHOD(Program, "a bound of memory holds at the peak of a run, and what can't be split is told", "[gl]")
{
    if (!hasOpenGl())
        return;
    // One layer of many views in two tables: 67 MB of results, that may be gathered a part at a time.
    std::string text = contentOf(std::string(SKY_SOURCE_DIR) + "/bench/earth-small-4-wavelengths.atmo");
    for (const auto& [key, size] : {std::pair{"VZA", "1024"}, {"dot(view,sun)", "64"}, {"SZA", "32"}}) {
        const std::string line = std::string("\nscattering texture size for ") + key + ": ";
        const std::size_t value = text.find(line) + line.size();
        text.replace(value, text.find('\n', value) - value, size);
    }
    directory.file("views.atmo", text);
    const auto taken = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"views.atmo", "--out-dir", "model", "--only",      "single",
                                           "--radiance", "--quality", "draft", "--altitudes", "0..0"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        Run run;
        run.environment = {"LP_NUM_THREADS=2"}; // each takes some
        const Outcome outcome = calcmysky(arguments, run);
        INFO(outcome.output << outcome.error);
        REQUIRE(outcome.exitCode == 0);
        return outcome;
    };
    constexpr std::size_t bound = std::size_t(300) << 20; // between what is needed and what would be taken
    const Outcome whole = taken({}), split = taken({"--max-memory", "300M"});
    CHECK(whole.peakBytes > bound);
    CHECK(split.peakBytes <= bound);
    CHECK_THAT(split.error, !Contains("--max-memory"));
    const Outcome plan = taken({"--max-memory", "140M", "--dry-run"});
    CHECK_THAT(plan.error, Contains("--max-memory: 147 MB won't be enough") && Contains("are needed for: single-scattering/"));
    for (const auto& [options, run] :
         {std::pair{std::vector<std::string>{"--dry-run"}, &whole}, {{"--dry-run", "--max-memory", "300M"}, &split}}) {
        const std::string told = taken(options).output;
        std::smatch total;
        REQUIRE(std::regex_search(told, total, std::regex("(\\d+) MB +\\d+ MB  memory: the largest stage")));
        const double ratio = 1e6 * std::stod(total[1]) / double(run->peakBytes);
        INFO(told << "taken " << run->peakBytes);
        CHECK((ratio > 0.67 && ratio < 1.5));
    }
}
