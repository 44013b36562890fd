#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "progress.hpp"

using namespace sky::cli;

namespace {

/// A terminal of our own, with a clock that we turn.
struct Stage {
    std::ostringstream stream;
    double seconds = 0;
    bool terminal = false;
    int columns = 80;

    std::unique_ptr<Reporter> reporter(ProgressStyle style, bool quiet = false)
    {
        return makeReporter(style, quiet, {stream, terminal, false, [this] { return columns; }, [this] { return seconds; }});
    }
    /// What was said since the last call.
    std::string heard()
    {
        std::string text = stream.str();
        stream.str({});
        return text;
    }
};

} // namespace

TEST_CASE("a bar shows how much is done, the stage, and the time left at the pace so far")
{
    Stage stage;
    stage.terminal = true;
    const auto reporter = stage.reporter(ProgressStyle::Automatic);
    reporter->stage("moments", 0);
    CHECK(stage.heard() == "\r[--------------------------]   0 %  moments\033[K");
    stage.seconds = 3;
    reporter->advance(0.25);
    CHECK(stage.heard() == "\r[#######-------------------]  25 %  moments, 9.0 s left\033[K");
    stage.seconds = 3.01;
    reporter->advance(0.26);
    CHECK(stage.heard() == ""); // too soon to draw again
    reporter->finished();
    CHECK(stage.heard() == "\r\033[K");
}

TEST_CASE("a bar fits a narrow terminal")
{
    Stage stage;
    stage.terminal = true;
    stage.columns = 30;
    stage.reporter(ProgressStyle::Bar)->stage("a stage with a long name indeed", 1);
    CHECK(stage.heard() == "\r[#########] 100 %  a stage wi\033[K");
}

TEST_CASE("a bar makes room for warnings and errors")
{
    Stage stage;
    const auto reporter = stage.reporter(ProgressStyle::Bar);
    reporter->stage("moments", 0);
    stage.heard();
    reporter->warning("thin air.");
    CHECK(stage.heard() == "\r\033[Kcalcmysky: warning: thin air.\n");
    reporter->failed("no disk.", 1);
    CHECK(stage.heard() == "calcmysky: no disk.\n");
}

TEST_CASE("where nobody watches, each stage is one plain line")
{
    Stage stage;
    const auto reporter = stage.reporter(ProgressStyle::Automatic);
    reporter->stage("medium", 0);
    reporter->advance(0.1);
    reporter->stage("moments", 0.123);
    reporter->finished();
    CHECK(stage.heard() == "  0 %  medium\n 12 %  moments\n");
}

TEST_CASE("quiet keeps errors, and `none` keeps warnings too")
{
    Stage stage;
    for (const bool quiet : {true, false}) {
        const auto reporter = stage.reporter(quiet ? ProgressStyle::Automatic : ProgressStyle::None, quiet);
        reporter->stage("medium", 0);
        reporter->advance(0.5);
        CHECK(stage.heard() == "");
        reporter->warning("w");
        CHECK(stage.heard() == (quiet ? "" : "calcmysky: warning: w\n"));
        reporter->failed("e", 2);
        CHECK(stage.heard() == "calcmysky: e\n");
    }
}

TEST_CASE("JSON is one object per line, whatever the texts contain")
{
    Stage stage;
    const auto reporter = stage.reporter(ProgressStyle::Json);
    reporter->stage("moments", 0.5);
    stage.seconds = 4;
    reporter->advance(0.8);
    reporter->warning("line\nbreak, \"quotes\", not UTF-8: \xff");
    reporter->failed("gone", 1);
    std::istringstream lines(stage.heard());
    std::vector<nlohmann::json> objects;
    for (std::string line; std::getline(lines, line);)
        objects.push_back(nlohmann::json::parse(line));
    REQUIRE(objects.size() == 4);
    CHECK(objects[0] == nlohmann::json{{"event", "stage"}, {"stage", "moments"}, {"fraction", 0.5}, {"elapsed_s", 0.}});
    CHECK(objects[1]["event"] == "progress");
    CHECK(objects[1]["remaining_s"].get<double>() == Approx(1));
    CHECK(objects[2]["message"] == "line\nbreak, \"quotes\", not UTF-8: \xEF\xBF\xBD");
    CHECK(objects[3] == nlohmann::json{{"event", "error"}, {"message", "gone"}, {"exit_code", 1}});
}

TEST_CASE("progress never goes back")
{
    Stage stage;
    const auto reporter = stage.reporter(ProgressStyle::Json);
    reporter->stage("a", 0.5);
    stage.heard();
    reporter->stage("b", 0.3);
    CHECK(nlohmann::json::parse(stage.heard())["fraction"] == 0.5);
    reporter->stage("c", 7);
    CHECK(nlohmann::json::parse(stage.heard())["fraction"] == 1);
}
