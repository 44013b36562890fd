#include "base/terminal.hpp"

#include <cstdlib>
#include <string_view>

#ifdef _WIN32
#define NOMINMAX
#include <windows.h>
#else
#include <sys/ioctl.h>
#include <unistd.h>
#endif

namespace sky {

namespace {

#ifdef _WIN32
HANDLE handleOf(Stream stream) { return GetStdHandle(stream == Stream::Output ? STD_OUTPUT_HANDLE : STD_ERROR_HANDLE); }
#else
int handleOf(Stream stream) { return stream == Stream::Output ? STDOUT_FILENO : STDERR_FILENO; }
#endif

std::string_view environment(const char* name)
{
    const char* value = std::getenv(name);
    return value ? value : "";
}

} // namespace

bool isTerminal(Stream stream)
{
#ifdef _WIN32
    DWORD mode = 0;
    return GetConsoleMode(handleOf(stream), &mode) != 0;
#else
    return isatty(handleOf(stream)) != 0;
#endif
}

int terminalWidth(Stream stream)
{
    int width = 0;
#ifdef _WIN32
    CONSOLE_SCREEN_BUFFER_INFO info;
    if (GetConsoleScreenBufferInfo(handleOf(stream), &info))
        width = info.srWindow.Right - info.srWindow.Left + 1;
#else
    winsize size{};
    if (ioctl(handleOf(stream), TIOCGWINSZ, &size) == 0)
        width = size.ws_col;
#endif
    return width > 0 ? width : 80;
}

bool wantsColour(Stream stream)
{
    if (!environment("NO_COLOR").empty() || !isTerminal(stream))
        return false;
#ifdef _WIN32
    const HANDLE handle = handleOf(stream);
    DWORD mode = 0;
    return GetConsoleMode(handle, &mode) && SetConsoleMode(handle, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
#else
    return !environment("TERM").empty() && environment("TERM") != "dumb";
#endif
}

} // namespace sky
