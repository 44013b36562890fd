#include "computation.hpp"

#include "base/error.hpp"
#include "base/files.hpp"
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace showmysky::app::preview {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t mostOtherText = 4000; // bytes kept of what isn't progress

bool isProgram(const fs::path& path)
{
    std::error_code error;
    return fs::is_regular_file(path, error) && access(path.c_str(), X_OK) == 0;
}

/// What to do in the child between fork and exec.
class SpawnActions
{
public:
    explicit SpawnActions(int errorPipe)
    {
        posix_spawn_file_actions_init(&actions_);
        posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_adddup2(&actions_, errorPipe, STDERR_FILENO);
    }
    ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }
    SpawnActions(const SpawnActions&) = delete;
    SpawnActions& operator=(const SpawnActions&) = delete;
    const posix_spawn_file_actions_t* get() const { return &actions_; }

private:
    posix_spawn_file_actions_t actions_{};
};

} // namespace

fs::path findCalcmysky()
{
    std::error_code error;
    const fs::path self = fs::read_symlink("/proc/self/exe", error);
    if (!error && isProgram(self.parent_path() / "calcmysky"))
        return self.parent_path() / "calcmysky";
    const char* variable = std::getenv("PATH");
    std::string rest = variable ? variable : "";
    while (!rest.empty()) {
        const auto colon = rest.find(':');
        const fs::path candidate = fs::path(rest.substr(0, colon)) / "calcmysky";
        if (isProgram(candidate))
            return candidate;
        rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
    }
    throw sky::FileError("A description is computed by the program `calcmysky`, but there is none beside `showmysky` and "
                         "none in PATH. Install it, or open a model directory.");
}

Computation::Computation(const fs::path& calcmysky, const fs::path& description, const fs::path& modelDirectory)
{
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        throw sky::FileError("Cannot talk to `" + calcmysky.string() + "`: " + sky::systemReason(errno) + ".");
    pipe_ = ends[0];
    fcntl(pipe_, F_SETFL, O_NONBLOCK);
    std::array<std::string, 7> words{
        calcmysky.string(), description.string(), "--only", "moments", "--progress", "json", "--out-dir=" + modelDirectory.string()};
    std::array<char*, words.size() + 1> arguments{};
    for (std::size_t i = 0; i < words.size(); ++i)
        arguments[i] = words[i].data();
    const SpawnActions actions(ends[1]);
    const int failure = posix_spawn(&child_, calcmysky.c_str(), actions.get(), nullptr, arguments.data(), environ);
    close(ends[1]);
    if (failure != 0) {
        close(pipe_);
        throw sky::FileError("Cannot start `" + calcmysky.string() + "`: " + sky::systemReason(failure) + ".");
    }
}

Computation::~Computation()
{
    if (!done_) {
        kill(child_, SIGTERM);
        waitpid(child_, nullptr, 0);
    }
    close(pipe_);
}

void Computation::update()
{
    if (done_)
        return;
    int status = 0;
    const bool ended = waitpid(child_, &status, WNOHANG) == child_;
    read();
    if (!ended)
        return;
    done_ = true;
    if (problem_.empty() && !(WIFEXITED(status) && WEXITSTATUS(status) == 0))
        problem_ = other_.empty() ? "calcmysky ended without a word." : other_;
}

void Computation::read()
{
    std::array<char, 4096> buffer;
    for (;;) {
        const auto count = ::read(pipe_, buffer.data(), buffer.size());
        if (count <= 0)
            break;
        unread_.append(buffer.data(), static_cast<std::size_t>(count));
    }
    for (auto end = unread_.find('\n'); end != std::string::npos; end = unread_.find('\n')) {
        understand(unread_.substr(0, end));
        unread_.erase(0, end + 1);
    }
}

void Computation::understand(const std::string& line)
{
    const auto object = nlohmann::json::parse(line, nullptr, false);
    if (!object.is_object()) {
        if (other_.size() + line.size() < mostOtherText)
            other_ += line + "\n";
        return;
    }
    const auto text = [&](const char* key) {
        return object.contains(key) && object[key].is_string() ? object[key].get<std::string>() : std::string();
    };
    if (text("event") == "error")
        problem_ = text("message");
    if (!text("stage").empty())
        stage_ = text("stage");
    if (object.contains("fraction") && object["fraction"].is_number())
        fraction_ = object["fraction"].get<double>();
}

} // namespace showmysky::app::preview
