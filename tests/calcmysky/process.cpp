#include "process.hpp"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace sky::test {

namespace {

struct Pipe {
    int ends[2];
    Pipe()
    {
        if (pipe2(ends, O_CLOEXEC) != 0)
            throw std::system_error(errno, std::generic_category(), "pipe");
    }
    ~Pipe()
    {
        closeEnd(0);
        closeEnd(1);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    void closeEnd(int end)
    {
        if (ends[end] >= 0)
            close(ends[end]);
        ends[end] = -1;
    }
};

[[noreturn]] void becomeChild(const Run& what, const Pipe& in, const Pipe& out, const Pipe& err)
{
    dup2(in.ends[0], 0);
    dup2(out.ends[1], 1);
    dup2(err.ends[1], 2);
    if (!what.directory.empty() && chdir(what.directory.c_str()) != 0)
        _exit(126);
    for (const std::string& setting : what.environment) {
        const std::size_t equals = setting.find('=');
        if (equals == std::string::npos)
            unsetenv(setting.c_str());
        else
            setenv(setting.substr(0, equals).c_str(), setting.substr(equals + 1).c_str(), 1);
    }
    std::vector<char*> arguments;
    for (const std::string& argument : what.arguments)
        arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    execv(arguments.front(), arguments.data());
    _exit(127);
}

} // namespace

Outcome run(const Run& what)
{
    Pipe in, out, err;
    const pid_t child = fork();
    if (child < 0)
        throw std::system_error(errno, std::generic_category(), "fork");
    if (child == 0)
        becomeChild(what, in, out, err);
    in.closeEnd(0);
    out.closeEnd(1);
    err.closeEnd(1);
    std::signal(SIGPIPE, SIG_IGN); // a program that refuses its options does not read its input
    for (std::size_t sent = 0; sent < what.input.size();) {
        const ssize_t n = write(in.ends[1], what.input.data() + sent, what.input.size() - sent);
        if (n <= 0)
            break;
        sent += static_cast<std::size_t>(n);
    }
    if (what.signalAfter.empty() || what.signal == 0)
        in.closeEnd(1);

    Outcome outcome;
    bool signalSent = what.signal == 0;
    while (out.ends[0] >= 0 || err.ends[0] >= 0) {
        pollfd waiting[2] = {{out.ends[0], POLLIN, 0}, {err.ends[0], POLLIN, 0}};
        poll(waiting, 2, -1);
        for (const auto& [pipe, text, events] :
             {std::tuple{&out, &outcome.output, waiting[0].revents}, std::tuple{&err, &outcome.error, waiting[1].revents}}) {
            if (pipe->ends[0] < 0 || events == 0)
                continue;
            char buffer[4096];
            const ssize_t n = read(pipe->ends[0], buffer, sizeof buffer);
            if (n > 0)
                text->append(buffer, static_cast<std::size_t>(n));
            else
                pipe->closeEnd(0);
        }
        if (!signalSent && (outcome.output + outcome.error).find(what.signalAfter) != std::string::npos) {
            kill(child, what.signal);
            signalSent = true;
        }
    }
    int status = 0;
    rusage used{};
    wait4(child, &status, 0, &used);
    outcome.peakBytes = static_cast<std::size_t>(used.ru_maxrss) * 1024;
    outcome.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return outcome;
}

TemporaryDirectory::TemporaryDirectory()
{
    std::string pattern = (std::filesystem::temp_directory_path() / "calcmysky-XXXXXX").string();
    if (!mkdtemp(pattern.data()))
        throw std::system_error(errno, std::generic_category(), "mkdtemp");
    path_ = pattern;
}

TemporaryDirectory::~TemporaryDirectory()
{
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TemporaryDirectory::file(const std::string& name, const std::string& text) const
{
    std::ofstream(path_ / name) << text;
    return path_ / name;
}

} // namespace sky::test
