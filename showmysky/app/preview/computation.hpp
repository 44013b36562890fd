#pragma once
// A description is computed by the program calcmysky, as a child process that is asked now and then how far it is.

#include <filesystem>
#include <string>
#include <sys/types.h>

namespace showmysky::app::preview {

/// The program beside ours, or the one in PATH.   throws sky::FileError where there is neither
std::filesystem::path findCalcmysky();

/// One run of `calcmysky DESCRIPTION --only moments`. Stops the child when it dies.
class Computation
{
public:
    /// throws sky::FileError where the program can't be started
    Computation(const std::filesystem::path& calcmysky, const std::filesystem::path& description,
                const std::filesystem::path& modelDirectory);
    ~Computation();
    Computation(const Computation&) = delete;
    Computation& operator=(const Computation&) = delete;

    /// Never waits.
    void update();
    bool done() const { return done_; }
    double fraction() const { return fraction_; }
    const std::string& stage() const { return stage_; }
    /// Empty where all went well; otherwise the program's own words.
    const std::string& problem() const { return problem_; }

private:
    void read();
    void understand(const std::string& line);

    pid_t child_ = -1;
    int pipe_ = -1;
    bool done_ = false;
    double fraction_ = 0;
    std::string stage_ = "starting", problem_, unread_, other_;
};

} // namespace showmysky::app::preview
