#include "progress.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>

#include <nlohmann/json.hpp>

#include "base/interrupt.hpp"
#include "base/stopwatch.hpp"
#include "base/terminal.hpp"
#include "values.hpp"

namespace sky::cli {

bool Reporter::cancelled() const { return interrupted(); }

namespace {

constexpr double secondsBetweenUpdates = 0.1;

/// What all styles keep: the stage, how much is done, and since when.
class Clock
{
public:
    explicit Clock(const std::function<double()>& secondsNow) : now_(secondsNow), start_(secondsNow()) {}

    double elapsed() const { return now_() - start_; }
    double fraction() const { return fraction_; }
    void reach(double fraction) { fraction_ = std::clamp(fraction, fraction_, 1.); }
    /// Seconds left if the work goes on at its pace; nothing while too little is done to tell.
    std::optional<double> remaining() const
    {
        if (fraction_ < 0.01 || elapsed() < 0.5)
            return {};
        return elapsed() * (1 - fraction_) / fraction_;
    }
    /// True at most every tenth of a second: a terminal can't show more.
    bool due()
    {
        if (lastUpdate_ && elapsed() - *lastUpdate_ < secondsBetweenUpdates)
            return false;
        lastUpdate_ = elapsed();
        return true;
    }

private:
    std::function<double()> now_;
    double start_;
    double fraction_ = 0;
    std::optional<double> lastUpdate_;
};

/// Errors, and warnings unless quiet.
class Plain : public Reporter
{
public:
    Plain(ReporterSurroundings surroundings, bool quiet) : to_(std::move(surroundings)), quiet_(quiet) {}

    void stage(const std::string&, double) override {}
    void advance(double) override {}
    void warning(const std::string& sentence) override
    {
        if (!quiet_)
            to_.stream << "calcmysky: " << (to_.colour ? "\033[33mwarning:\033[0m " : "warning: ") << sentence << std::endl;
    }
    void note(const std::string& text) override { to_.stream << text << std::endl; }
    void remark(const std::string& sentence) override
    {
        if (!quiet_)
            note(sentence);
    }
    void finished() override {}
    void failed(const std::string& message, int) override { printError(to_, message); }

protected:
    ReporterSurroundings to_;

private:
    bool quiet_;
};

/// One line per stage, for logs.
class Lines : public Plain
{
public:
    explicit Lines(ReporterSurroundings surroundings) : Plain(std::move(surroundings), false) {}

    void stage(const std::string& name, double fraction) override
    {
        const long percent = std::lround(100 * std::clamp(fraction, 0., 1.));
        to_.stream << (percent < 10 ? "  " : percent < 100 ? " " : "") << percent << " %  " << name << std::endl;
    }
};

/// [#######-------]  48 %  multiple scattering, 12 s left
class Bar : public Plain
{
public:
    explicit Bar(ReporterSurroundings surroundings) : Plain(std::move(surroundings), false), clock_(to_.secondsNow) {}

    void stage(const std::string& name, double fraction) override
    {
        stage_ = name;
        clock_.reach(fraction);
        draw();
    }
    void advance(double fraction) override
    {
        clock_.reach(fraction);
        if (clock_.due())
            draw();
    }
    void warning(const std::string& sentence) override
    {
        erase();
        Plain::warning(sentence);
    }
    void note(const std::string& text) override
    {
        erase();
        Plain::note(text);
    }
    void finished() override { erase(); }
    void failed(const std::string& message, int exitCode) override
    {
        erase();
        Plain::failed(message, exitCode);
    }

private:
    void draw()
    {
        // The last column stays free: writing there would wrap the line on some terminals.
        const int width = std::max(to_.width() - 1, 20);
        const int cells = std::clamp(width / 3, 8, 30);
        const int full = static_cast<int>(std::lround(clock_.fraction() * cells));
        const long percent = std::lround(100 * clock_.fraction());
        std::string line = "[" + std::string(static_cast<std::size_t>(full), '#') +
                           std::string(static_cast<std::size_t>(cells - full), '-') + "] " + (percent < 100 ? " " : "") +
                           (percent < 10 ? " " : "") + std::to_string(percent) + " %  " + stage_;
        if (const auto left = clock_.remaining())
            line += ", " + formatDuration(std::ceil(*left)) + " left";
        to_.stream << '\r' << line.substr(0, static_cast<std::size_t>(width)) << "\033[K" << std::flush;
        drawn_ = true;
    }
    void erase()
    {
        if (drawn_)
            to_.stream << "\r\033[K" << std::flush;
        drawn_ = false;
    }

    Clock clock_;
    std::string stage_;
    bool drawn_ = false;
};

/// One JSON object per line.
class Json : public Reporter
{
public:
    explicit Json(ReporterSurroundings surroundings) : to_(std::move(surroundings)), clock_(to_.secondsNow) {}

    void stage(const std::string& name, double fraction) override
    {
        stage_ = name;
        clock_.reach(fraction);
        print(progressOf("stage"));
    }
    void advance(double fraction) override
    {
        clock_.reach(fraction);
        if (clock_.due())
            print(progressOf("progress"));
    }
    void warning(const std::string& sentence) override { print({{"event", "warning"}, {"message", sentence}}); }
    void note(const std::string& text) override { print({{"event", "note"}, {"message", text}}); }
    void remark(const std::string& sentence) override { note(sentence); }
    void finished() override
    {
        clock_.reach(1);
        print({{"event", "done"}, {"elapsed_s", clock_.elapsed()}});
    }
    void failed(const std::string& message, int exitCode) override
    {
        print({{"event", "error"}, {"message", message}, {"exit_code", exitCode}});
    }

private:
    nlohmann::ordered_json progressOf(const char* event) const
    {
        nlohmann::ordered_json object{
            {"event", event}, {"stage", stage_}, {"fraction", clock_.fraction()}, {"elapsed_s", clock_.elapsed()}};
        if (const auto left = clock_.remaining())
            object["remaining_s"] = *left;
        return object;
    }
    void print(const nlohmann::ordered_json& object)
    {
        // Messages may quote a description that is not UTF-8: replace what JSON can't carry.
        to_.stream << object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << std::endl;
    }

    ReporterSurroundings to_;
    Clock clock_;
    std::string stage_;
};

} // namespace

std::unique_ptr<Reporter> makeReporter(ProgressStyle style, bool quiet, ReporterSurroundings surroundings)
{
    if (style == ProgressStyle::Json)
        return std::make_unique<Json>(std::move(surroundings));
    if (quiet || style == ProgressStyle::None)
        return std::make_unique<Plain>(std::move(surroundings), quiet);
    if (style == ProgressStyle::Bar || surroundings.terminal)
        return std::make_unique<Bar>(std::move(surroundings));
    return std::make_unique<Lines>(std::move(surroundings));
}

ReporterSurroundings standardError()
{
    const base::Stopwatch watch;
    return {std::cerr, isTerminal(Stream::Error), wantsColour(Stream::Error), [] { return terminalWidth(Stream::Error); },
            [watch] { return watch.seconds(); }};
}

void printError(const ReporterSurroundings& to, const std::string& message)
{
    to.stream << (to.colour ? "\033[1;31mcalcmysky:\033[0m " : "calcmysky: ") << message << std::endl;
}

} // namespace sky::cli
