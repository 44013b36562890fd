#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace sky::test {

/// How a process ended and what it said.
struct Outcome {
    int exitCode = -1; ///< -1 where a signal killed it
    std::string output, error;
    std::size_t peakBytes = 0; ///< most memory that it held at a time
};

struct Run {
    std::vector<std::string> arguments;   ///< the program's path first
    std::string input;                    ///< standard input
    std::vector<std::string> environment; ///< "NAME=value", added to ours; "NAME" removes it
    std::filesystem::path directory;      ///< where it runs; empty: here
    std::string signalAfter;              ///< once this text stands on standard output or error, `signal` is sent
    int signal = 0;
};

/// Runs a program without a shell and waits for its end.
Outcome run(const Run& what);

/// An empty directory that is removed at the end of the scope.
class TemporaryDirectory
{
public:
    TemporaryDirectory();
    ~TemporaryDirectory();
    TemporaryDirectory(const TemporaryDirectory&) = delete;
    TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
    const std::filesystem::path& path() const { return path_; }
    /// Makes a file in it and returns its path.
    std::filesystem::path file(const std::string& name, const std::string& text = {}) const;

private:
    std::filesystem::path path_;
};

} // namespace sky::test
