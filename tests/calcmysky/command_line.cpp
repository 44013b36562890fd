// The command line in front of a solver that obeys the name of its description; see fake.cpp.

#include <csignal>
#include <fstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "process.hpp"

using namespace sky::test;
using Catch::Contains;

namespace {

/// A directory with descriptions for every fate of a run.
struct Desk {
    TemporaryDirectory directory;
    Desk()
    {
        for (const char* name : {"good", "slow", "typo", "driver", "nan", "disk", "memory", "odd", "doctor"})
            directory.file(std::string(name) + ".atmo");
    }
    Outcome calcmysky(std::vector<std::string> arguments, Run run = {}) const
    {
        arguments.insert(arguments.begin(), CALCMYSKY_FAKE);
        run.arguments = std::move(arguments);
        run.directory = directory.path();
        return sky::test::run(run);
    }
    /// The fake's answer to good options.
    std::string computed(std::vector<std::string> arguments) const
    {
        arguments.insert(arguments.begin(), {"good.atmo", "--out-dir", "model"});
        const Outcome outcome = calcmysky(arguments);
        INFO(outcome.error);
        CHECK(outcome.exitCode == 0);
        return outcome.output;
    }
    /// The complaint about wrong options, which must come before any work.
    std::string refused(const std::vector<std::string>& arguments) const
    {
        const Outcome outcome = calcmysky(arguments);
        CHECK(outcome.exitCode == 2);
        CHECK(outcome.output.find("parts") == std::string::npos);
        CHECK_THAT(outcome.error, Catch::StartsWith("calcmysky: "));
        return outcome.error;
    }
};

std::string contentOf(const std::filesystem::path& file)
{
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

} // namespace

TEST_CASE_METHOD(Desk, "the text of --help is the one kept beside this test")
{
    const Outcome outcome = calcmysky({"--help"});
    CHECK(outcome.exitCode == 0);
    CHECK(outcome.output == contentOf(std::string(SKY_TEST_DATA) + "/help.txt"));
    CHECK(calcmysky({"-h"}).output == outcome.output);
}

TEST_CASE_METHOD(Desk, "a subcommand has its own --help")
{
    const Outcome outcome = calcmysky({"doctor", "--help"});
    CHECK(outcome.exitCode == 0);
    CHECK_THAT(outcome.output, Contains("Usage: calcmysky doctor") && !Contains("Examples:"));
}

TEST_CASE_METHOD(Desk, "every option of --help is explained in docs/options.md")
{
    const std::string help = calcmysky({"--help"}).output;
    const std::string docs = contentOf(std::string(SKY_SOURCE_DIR) + "/docs/options.md");
    int found = 0;
    for (std::size_t at = help.find("\n  -"); at != std::string::npos; at = help.find("\n  -", at + 1)) {
        std::size_t begin = help.find("--", at);
        const std::string name = help.substr(begin, help.find_first_of(" \n", begin) - begin);
        CHECK_THAT(docs, Contains("`" + name));
        ++found;
    }
    CHECK(found >= 30);
}

TEST_CASE_METHOD(Desk, "the option --version prints one line")
{
    const Outcome outcome = calcmysky({"--version"});
    CHECK(outcome.exitCode == 0);
    CHECK_THAT(outcome.output, Catch::Matches("calcmysky [0-9]+\\.[0-9]+\\.[0-9]+\n"));
    CHECK(calcmysky({"-v"}).output == outcome.output);
}

TEST_CASE_METHOD(Desk, "without options all parts are computed at the usual quality")
{
    const std::string text = computed({});
    CHECK_THAT(text, Contains("parts moments transmittance irradiance single multiple light-pollution eclipsed\n"));
    CHECK_THAT(text, Contains("radiance=0 ") && Contains(" quality=normal tolerance=0 memory=0\n"));
    CHECK_THAT(text, Contains("save\nbackend=0 device=-1 debug=0\n"));
    CHECK_THAT(text, Contains("read point=0 outside=0\n"));
    CHECK_THAT(text, Contains("model: 2 B in "));
}

TEST_CASE_METHOD(Desk, "each option reaches the solver")
{
    CHECK_THAT(computed({"--radiance"}), Contains("radiance=1"));
    CHECK_THAT(computed({"--texture-save-precision", "24"}), Contains("bits=24"));
    CHECK_THAT(computed({"--texture-save-precision=1"}), Contains("bits=1 "));
    CHECK_THAT(computed({"--only", "moments,single"}), Contains("parts moments single\n"));
    CHECK_THAT(computed({"--skip", "moments,single,multiple,eclipsed"}), Contains("parts transmittance irradiance light-pollution\n"));
    CHECK_THAT(computed({"--no-eds-tex"}), Contains("multiple light-pollution\n"));
    CHECK_THAT(computed({"--no-save-tex"}), Contains("parts moments\n"));
    CHECK_THAT(computed({"--altitudes", "2..5"}), Contains("layers=2..5"));
    CHECK_THAT(computed({"--tolerance", "0.01"}), Contains("quality=picked tolerance=0.01"));
    CHECK_THAT(computed({"--quality", "fine"}), Contains("quality=fine"));
    CHECK_THAT(computed({"--tolerance", "0.01", "--quality", "fine"}), Contains("quality=fine tolerance=0.01"));
    CHECK_THAT(computed({"--max-memory", "100MB"}), Contains("memory=100000000"));
    CHECK_THAT(computed({"--point-sampled-spectra"}), Contains("point=1"));
    CHECK_THAT(computed({"--extend-spectra", "zero"}), Contains("outside=1"));
    CHECK_THAT(computed({"--extend-spectra", "end"}), Contains("outside=2"));
    CHECK_THAT(computed({"--gl", "egl"}), Contains("backend=1 "));
    CHECK_THAT(computed({"--gl", "osmesa"}), Contains("backend=2 "));
    CHECK_THAT(computed({"--device", "3"}), Contains("backend=1 device=3"));
    CHECK_THAT(computed({"--opengl-debug"}), Contains("debug=1"));
    CHECK_THAT(computed({"--opengl-debug-full"}), Contains("debug=2"));
}

TEST_CASE_METHOD(Desk, "each debugging option asks for its own intermediate table")
{
    CHECK_THAT(computed({"--save-irradiance"}), Contains("save irradiance\n"));
    CHECK_THAT(computed({"--save-scat-density"}), Contains("save density\n"));
    CHECK_THAT(computed({"--save-scat-density2-from-ground"}), Contains("save density2\n"));
    CHECK_THAT(computed({"--save-delta-scattering"}), Contains("save delta\n"));
    CHECK_THAT(computed({"--save-accum-scattering"}), Contains("save accumulated\n"));
    CHECK_THAT(computed({"--save-light-pollution"}), Contains("save pollution\n"));
}

TEST_CASE_METHOD(Desk, "options may stand before and after the description")
{
    const Outcome outcome = calcmysky({"--out-dir", "model", "--radiance", "good.atmo", "--only", "single"});
    CHECK(outcome.exitCode == 0);
    CHECK_THAT(outcome.output, Contains("parts single\nradiance=1"));
}

TEST_CASE_METHOD(Desk, "a misspelt option or value is refused with a suggestion")
{
    CHECK_THAT(refused({"good.atmo", "--outdir", "x"}), Contains("no option `--outdir`. Did you mean `--out-dir`?"));
    CHECK_THAT(refused({"good.atmo", "--radiacne"}), Contains("Did you mean `--radiance`?"));
    CHECK_THAT(refused({"good.atmo", "--texture-precision=3", "--out-dir", "x"}), Contains("`--texture-precision`"));
    CHECK_THAT(refused({"good.atmo", "--out-dir", "x", "--only", "momets"}), Contains("Did you mean `moments`?"));
    CHECK_THAT(refused({"good.atmo", "--out-dir", "x", "--quality", "fien"}), Contains("Did you mean `fine`?"));
    CHECK_THAT(refused({"docter", "--out-dir", "x", "--gl", "elg"}), Contains("auto, egl, osmesa. Did you mean `egl`?"));
    CHECK_THAT(refused({"good.atmo", "--xyzzy"}), !Contains("Did you mean"));
}

TEST_CASE_METHOD(Desk, "missing and surplus words are refused")
{
    CHECK_THAT(refused({}), Contains("Which atmosphere?"));
    CHECK_THAT(refused({"good.atmo"}), Contains("Add --out-dir DIR."));
    CHECK_THAT(refused({"good.atmo", "--out-dir"}), Contains("--out-dir needs a value."));
    CHECK_THAT(refused({"good.atmo", "other.atmo", "--out-dir", "x"}), Contains("`good.atmo` and `other.atmo`"));
    CHECK_THAT(refused({"good.atmo", "--out-dir", "x", "--out-dir", "y"}), Contains("--out-dir was given more than once"));
    CHECK_THAT(refused({"none.atmo", "--out-dir", "x"}), Contains("There is no file `none.atmo`."));
    CHECK_THAT(refused({".", "--out-dir", "x"}), Contains("is a directory"));
    CHECK_THAT(refused({"doctor", "good.atmo"}), Contains("`doctor` takes no description"));
    directory.file("file");
    CHECK_THAT(refused({"good.atmo", "--out-dir", "file"}), Contains("`file` is a file"));
}

TEST_CASE_METHOD(Desk, "values out of range are refused with the range")
{
    for (const char* bits : {"0", "25", "x", "1.5", ""})
        CHECK_THAT(refused({"good.atmo", "--out-dir", "x", "--texture-save-precision", bits}), Contains("from 1 to 24"));
    CHECK_THAT(refused({"good.atmo", "--out-dir", "x", "--altitudes", "5..2"}), Contains("FIRST..LAST"));
    CHECK_THAT(refused({"good.atmo", "--out-dir", "x", "--altitudes", "0..8"}), Contains("8 altitude layers, 0..7"));
    CHECK_THAT(refused({"good.atmo", "--out-dir", "x", "--tolerance", "2"}), Contains("below 1"));
    CHECK_THAT(refused({"good.atmo", "--out-dir", "x", "--max-memory", "3X"}), Contains("512M"));
    CHECK_THAT(refused({"good.atmo", "--out-dir", "x", "--device", "one"}), Contains("from 0 on"));
}

TEST_CASE_METHOD(Desk, "contradictions are refused")
{
    const auto both = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"good.atmo", "--out-dir", "x"});
        return refused(more);
    };
    CHECK_THAT(both({"--only", "single,moments", "--skip", "moments"}), Contains("--only asks for moments"));
    CHECK_THAT(both({"--only", "eclipsed", "--no-eds-tex"}), Contains("--no-eds-tex leaves it out"));
    CHECK_THAT(both({"--only", "single", "--no-save-tex"}), Contains("--no-save-tex and --only"));
    CHECK_THAT(both({"--no-save-tex", "--skip", "moments"}), Contains("nothing to write"));
    CHECK_THAT(both({"--save-light-pollution", "--skip", "light-pollution"}), Contains("needs the part light-pollution"));
    CHECK_THAT(both({"--dry-run", "--validate"}), Contains("give one of them"));
    CHECK_THAT(both({"--quiet", "--progress", "json"}), Contains("contradict"));
    CHECK_THAT(both({"--gl", "osmesa", "--device", "0"}), Contains("can't go with --gl osmesa"));
}

TEST_CASE_METHOD(Desk, "who can mend an error is in the exit code, and the old model stays")
{
    directory.file("model.json");
    std::filesystem::create_directory(directory.path() / "model");
    std::ofstream(directory.path() / "model/manifest.json") << "old";
    const auto fails = [&](const std::string& name, int exitCode, const std::string& message) {
        const Outcome outcome = calcmysky({name, "--out-dir", "model", "--progress", "none"});
        CHECK(outcome.exitCode == exitCode);
        CHECK_THAT(outcome.error, Contains(message));
        CHECK(contentOf(directory.path() / "model/manifest.json") == "old");
    };
    fails("typo.atmo", 2,
          "calcmysky: typo.atmo:3:1: unknown key `groud albedo`. Did you mean `ground albedo`?\n    groud albedo: "
          "0.3\n    ^\n");
    fails("driver.atmo", 1, "calcmysky: transmittance: the driver lost its context.\n");
    fails("nan.atmo", 1, "calcmysky: irradiance: texel (3, 5)");
    fails("disk.atmo", 1, "no space left");
    fails("memory.atmo", 1, "not enough memory. Try --max-memory");
    fails("odd.atmo", 1, "Something failed that should not: the fake knows no odd.atmo");
}

TEST_CASE_METHOD(Desk, "Ctrl-C and SIGTERM stop a run with code 130")
{
    for (const int signal : {SIGINT, SIGTERM}) {
        Run stop;
        stop.signalAfter = "medium";
        stop.signal = signal;
        const Outcome outcome = calcmysky({"slow.atmo", "--out-dir", "model"}, stop);
        CHECK(outcome.exitCode == 130);
        CHECK_THAT(outcome.error, Catch::EndsWith("calcmysky: Stopped. Nothing was changed.\n"));
        CHECK_FALSE(std::filesystem::exists(directory.path() / "model"));
    }
}

TEST_CASE_METHOD(Desk, "the description may come from standard input")
{
    Run piped;
    piped.input = "good.atmo\n";
    CHECK(calcmysky({"-", "--out-dir", "model"}, piped).exitCode == 0);
    CHECK(std::filesystem::exists(directory.path() / "model/manifest.json"));
}

TEST_CASE_METHOD(Desk, "the option --dry-run prints the plan and writes nothing")
{
    const Outcome outcome = calcmysky({"good.atmo", "--dry-run", "--out-dir", "model"});
    CHECK(outcome.exitCode == 0);
    CHECK_THAT(outcome.output, Contains("what                                         time   memory     disk  why\n"
                                        "moments                     computed       0.80 s   300 MB   120 kB\n"
                                        "eclipsed double scattering  skipped             -        -        -  --no-eds-tex\n"
                                        "total                                      0.80 s   300 MB   120 kB  memory: "));
    CHECK_FALSE(std::filesystem::exists(directory.path() / "model"));
    CHECK_THAT(calcmysky({"good.atmo", "--dry-run", "--skip", "moments"}).output, Contains("moments                     skipped"));
    CHECK(calcmysky({"good.atmo", "--dry-run"}).error.empty());
    CHECK(calcmysky({"good.atmo", "--dry-run", "--tolerance", "0.01"}).error == "picked for the tolerance.\n");
    CHECK(calcmysky({"good.atmo", "--dry-run", "--tolerance", "0.01", "--quiet"}).error.empty());
    CHECK_THAT(calcmysky({"good.atmo", "--dry-run", "--tolerance", "0.01", "--progress", "json"}).error, Contains("\"event\":\"note\""));
}

TEST_CASE_METHOD(Desk, "the option --validate needs no output directory and passes the verdict on")
{
    const Outcome good = calcmysky({"good.atmo", "--validate"});
    CHECK(good.exitCode == 0);
    CHECK_THAT(good.output, Catch::EndsWith("good.atmo: fine\n"));
    CHECK(calcmysky({"typo.atmo", "--validate"}).exitCode == 2);
    CHECK(calcmysky({"driver.atmo", "--validate"}).exitCode == 1);
}

TEST_CASE_METHOD(Desk, "progress goes to standard error in the style that was asked for")
{
    const auto said = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"good.atmo", "--out-dir", "model"});
        return calcmysky(more);
    };
    CHECK(said({}).error == "  0 %  medium\ncalcmysky: warning: the phase function was scaled by 1.01.\n 25 %  moments\n");
    CHECK(said({"--progress", "none"}).error == "calcmysky: warning: the phase function was scaled by 1.01.\n");
    CHECK_THAT(said({"--progress", "bar"}).error, Contains("\r[") && Contains("]  50 %  moments") && Catch::EndsWith("\r\033[K"));
    const Outcome quiet = said({"--quiet"});
    CHECK(quiet.error == "");
    CHECK_THAT(quiet.output, !Contains("model:"));
    CHECK_THAT(said({"--opengl-debug", "--quiet"}).error, Contains("OpenGL: buffer 3 will use video memory\n"));

    std::istringstream lines(said({"--progress", "json"}).error);
    std::vector<std::string> events;
    for (std::string line; std::getline(lines, line);)
        events.push_back(nlohmann::json::parse(line)["event"]);
    CHECK(events == std::vector<std::string>{"stage", "warning", "stage", "progress", "done"});
    const Outcome failed = calcmysky({"disk.atmo", "--out-dir", "model", "--progress", "json"});
    CHECK_THAT(failed.error, Catch::EndsWith("\"exit_code\":1}\n"));
}

TEST_CASE_METHOD(Desk, "a pipe gets no colours") { CHECK_THAT(refused({"good.atmo"}), !Contains("\033")); }

TEST_CASE_METHOD(Desk, "doctor tests the machine and says when it is a CPU", "[gl]")
{
    const Outcome outcome = calcmysky({"doctor"});
    INFO(outcome.output << outcome.error);
    if (outcome.exitCode == 1) {
        CHECK_THAT(outcome.output, Contains("NOT READY") && Contains("apt-get install"));
        WARN("no OpenGL here: only the advice was tested");
        return;
    }
    CHECK(outcome.exitCode == 0);
    CHECK_THAT(outcome.output, Contains("self-test passed") && Contains("OpenEXR 3") && Contains("storage buffers up to"));
    if (outcome.output.find("llvmpipe") != std::string::npos && outcome.output.find("(software: slow)") != std::string::npos)
        CHECK_THAT(outcome.output, Contains("READY"));
    CHECK_THAT(calcmysky({"doctor", "--gl", "egl"}).output, !Contains("\nOSMesa:"));
}

TEST_CASE_METHOD(Desk, "doctor without any driver says what to install")
{
    // The device is chosen by number, and there are not that many.
    const Outcome outcome = calcmysky({"doctor", "--device", "999"});
    CHECK(outcome.exitCode == 1);
    CHECK_THAT(outcome.output, Contains("cannot be used") && Contains("NOT READY") && Contains("libgl1-mesa-dri"));
}
