#include <charconv>
#include <optional>

#include "gl/shader_text.hpp"

namespace sky::gl {

namespace {

/// Reads a text from left to right; every step leaves it alone where it doesn't match.
class Scanner
{
public:
    explicit Scanner(std::string_view text) : rest_(text) {}

    bool skip(std::string_view expected)
    {
        if (!rest_.starts_with(expected))
            return false;
        rest_.remove_prefix(expected.size());
        return true;
    }

    std::optional<int> number()
    {
        int value = 0;
        const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
        if (error != std::errc() || value < 0)
            return std::nullopt;
        rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
        return value;
    }

    void spaces()
    {
        while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t'))
            rest_.remove_prefix(1);
    }

    std::string_view rest() const { return rest_; }

private:
    std::string_view rest_;
};

/// "12:34(5)", "12(34)", "12:34": the place at the start of a message, and the colon after it.
bool readPlace(Scanner& scanner, DriverMessage& message)
{
    Scanner s = scanner;
    const auto source = s.number();
    if (!source)
        return false;
    std::optional<int> line, column;
    if (s.skip(":")) { // Mesa, AMD, Intel, ANGLE, Apple
        line = s.number();
        if (s.skip("(")) {
            column = s.number();
            if (!column || !s.skip(")"))
                return false;
        }
    } else if (s.skip("(")) { // NVIDIA
        line = s.number();
        if (!s.skip(")"))
            return false;
    }
    s.spaces();
    if (!line || !s.skip(":"))
        return false;
    s.spaces();
    message.source = *source;
    message.line = *line;
    message.column = column.value_or(0);
    scanner = s;
    return true;
}

DriverMessage parseLine(std::string_view text)
{
    DriverMessage message;
    Scanner scanner(text);
    // AMD and its relatives say the severity first, Mesa and NVIDIA after the place.
    const bool errorFirst = scanner.skip("ERROR:");
    const bool warningFirst = !errorFirst && scanner.skip("WARNING:");
    scanner.spaces();
    readPlace(scanner, message);
    message.error = errorFirst || (!warningFirst && scanner.rest().starts_with("error"));
    scanner.skip("error: ");
    message.text = scanner.rest();
    return message;
}

} // namespace

std::vector<DriverMessage> parseDriverLog(std::string_view log)
{
    std::vector<DriverMessage> messages;
    while (!log.empty()) {
        const std::size_t end = log.find('\n');
        std::string_view line = log.substr(0, end);
        // Some drivers count the terminating zero into the log.
        while (!line.empty() && (line.back() == '\r' || line.back() == ' ' || line.back() == '\0'))
            line.remove_suffix(1);
        if (!line.empty())
            messages.push_back(parseLine(line));
        log = end == std::string_view::npos ? std::string_view() : log.substr(end + 1);
    }
    return messages;
}

} // namespace sky::gl
