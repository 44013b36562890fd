#pragma once
// How the work goes on, told to a person at a terminal, to a log, or to another program.

#include <functional>
#include <memory>
#include <ostream>
#include <string>

#include "options.hpp"

namespace sky::cli {

/// Speaks about one run. `finished` or `failed` is the last call.
class Reporter : public solver::Progress
{
public:
    bool cancelled() const override; ///< Ctrl-C
    /// Something to know that is not about progress: the driver's words, for instance.
    virtual void note(const std::string& text) = 0;
    virtual void finished() = 0;
    /// \param message what went wrong, whole; \param exitCode what the program will return
    virtual void failed(const std::string& message, int exitCode) = 0;
};

/// Where and when a reporter speaks; tests put their own here.
struct ReporterSurroundings {
    std::ostream& stream;
    bool terminal = false;
    bool colour = false;
    std::function<int()> width;         ///< columns of the terminal
    std::function<double()> secondsNow; ///< a clock that never goes back
};

/// A bar on a terminal, lines elsewhere, JSON, or errors and warnings only; as the options say.
std::unique_ptr<Reporter> makeReporter(ProgressStyle style, bool quiet, ReporterSurroundings surroundings);

/// Standard error of this process.
ReporterSurroundings standardError();

/// "calcmysky: message", the name in red where colours are welcome.
void printError(const ReporterSurroundings& to, const std::string& message);

} // namespace sky::cli
