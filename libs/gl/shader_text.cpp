#include "gl/shader_text.hpp"

#include <algorithm>
#include <optional>
#include <set>

namespace sky::gl {

namespace {

std::string_view trimLeft(std::string_view text)
{
    const std::size_t start = text.find_first_not_of(" \t\r\f\v");
    return start == std::string_view::npos ? std::string_view() : text.substr(start);
}

/// The word after '#', "include" for instance; `rest` gets what follows. Empty where the line is no directive.
std::string_view directive(std::string_view line, std::string_view& rest)
{
    line = trimLeft(line);
    if (line.empty() || line.front() != '#')
        return {};
    line = trimLeft(line.substr(1));
    std::size_t end = 0;
    while (end < line.size() && line[end] >= 'a' && line[end] <= 'z')
        ++end;
    rest = trimLeft(line.substr(end));
    return line.substr(0, end);
}

std::optional<std::string_view> includedName(std::string_view line)
{
    std::string_view rest;
    if (directive(line, rest) != "include" || rest.empty() || rest.front() != '"')
        return std::nullopt;
    const std::size_t end = rest.find('"', 1);
    if (end == std::string_view::npos)
        return std::nullopt;
    return rest.substr(1, end - 1);
}

/// Walks over the lines of a text and knows which of them start inside a block comment.
template<class PerLine>
bool forEachLine(std::string_view text, PerLine&& perLine)
{
    bool inComment = false;
    int number = 1;
    while (true) {
        const std::size_t end = text.find('\n');
        const std::string_view line = text.substr(0, end);
        perLine(line, number, inComment);
        for (std::size_t i = 0; i < line.size(); ++i) {
            const std::string_view two = line.substr(i, 2);
            if (inComment) {
                if (two == "*/") {
                    inComment = false;
                    ++i;
                }
            } else if (two == "//") {
                break;
            } else if (two == "/*") {
                inComment = true;
                ++i;
            }
        }
        if (end == std::string_view::npos || end + 1 == text.size())
            return inComment;
        text.remove_prefix(end + 1);
        ++number;
    }
}

std::string lineOf(std::string_view text, int number)
{
    std::string found;
    forEachLine(text, [&](std::string_view line, int n, bool) {
        if (n == number)
            found = line;
    });
    if (!found.empty() && found.back() == '\r')
        found.pop_back();
    return found;
}

[[noreturn]] void throwAt(const Snippet& snippet, int line, int column, const std::string& message)
{
    if (snippet.fromDescription)
        throw AtmoError({snippet.file, snippet.firstLine + line - 1, column}, message, lineOf(snippet.text, line));
    throw GlError(snippet.file + ":" + std::to_string(snippet.firstLine + line - 1) + ": " + message);
}

/// A block that leaves a bracket or comment open would be reported by the driver in the file that includes it, or swallow
/// parts of it; a directive could change how the rest is read. Found here, it has its own line.
void checkSelfContained(const Snippet& snippet)
{
    struct Bracket {
        char closing;
        int line, column;
    };
    std::vector<Bracket> open;
    bool inComment = false;
    int line = 1, column = 0, commentLine = 0, commentColumn = 0;
    const std::string_view text = snippet.text;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        ++column;
        if (c == '\n') {
            ++line;
            column = 0;
            continue;
        }
        const std::string_view two = text.substr(i, 2);
        if (inComment) {
            if (two == "*/") {
                inComment = false;
                ++i, ++column;
            }
        } else if (two == "//") {
            while (i + 1 < text.size() && text[i + 1] != '\n')
                ++i;
        } else if (two == "/*") {
            inComment = true;
            commentLine = line, commentColumn = column;
            ++i, ++column;
        } else if (c == '(' || c == '[' || c == '{') {
            open.push_back({c == '(' ? ')' : c == '[' ? ']' : '}', line, column});
        } else if (c == ')' || c == ']' || c == '}') {
            if (open.empty() || open.back().closing != c)
                throwAt(snippet, line, column, std::string("this \"") + c + "\" closes nothing.");
            open.pop_back();
        }
    }
    if (inComment)
        throwAt(snippet, commentLine, commentColumn, "this comment is never closed; expected \"*/\".");
    if (!open.empty())
        throwAt(snippet, open.back().line, open.back().column,
                std::string("this bracket is never closed; expected \"") + open.back().closing + "\".");
    forEachLine(text, [&](std::string_view lineText, int number, bool comment) {
        std::string_view rest;
        const std::string_view word = comment ? std::string_view() : directive(lineText, rest);
        for (const std::string_view banned : {"include", "line", "version", "extension"})
            if (word == banned)
                throwAt(snippet, number, static_cast<int>(lineText.find('#')) + 1,
                        "\"#" + std::string(word) + "\" can't be used in a code block.");
    });
}

class Expander
{
public:
    Expander(const SourceProvider& source, const std::vector<Snippet>& snippets) : source_(source), snippets_(snippets) {}

    ShaderText run(std::string_view path, const std::string& version, const std::vector<Define>& defines)
    {
        result_.origins.push_back({"<defines of " + std::string(path) + ">", nullptr});
        int line = 0;
        if (!version.empty())
            add("#version " + version, 0, ++line);
        if (version.ends_with("es"))
            for (const char* type : {"float", "int", "sampler2D", "sampler3D", "sampler2DArray"})
                add(std::string("precision highp ") + type + ";", 0, ++line);
        for (const Define& define : defines)
            add("#define " + define.name + " " + define.value, 0, ++line);
        include(path, "");
        return std::move(result_);
    }

private:
    void include(std::string_view name, const std::string& from)
    {
        if (!seen_.insert(std::string(name)).second)
            return;
        const int origin = static_cast<int>(result_.origins.size());
        if (name.starts_with("user:")) {
            const auto snippet =
                std::find_if(snippets_.begin(), snippets_.end(), [&](const Snippet& s) { return s.name == name.substr(5); });
            if (snippet == snippets_.end())
                throw GlError(from + "no block is given for #include \"" + std::string(name) + "\".");
            checkSelfContained(*snippet);
            result_.origins.push_back({snippet->file, &*snippet});
            int last = snippet->firstLine;
            forEachLine(snippet->text, [&](std::string_view line, int number, bool) {
                last = snippet->firstLine + number - 1;
                add(line, origin, last);
            });
            // The extra line takes what a backslash at the end of the block would join to it.
            add("", origin, last);
            return;
        }
        const std::string_view text = source_(name);
        if (text.empty())
            throw GlError(from + "there is no shader file \"" + std::string(name) + "\".");
        const std::string file(name);
        result_.origins.push_back({file, nullptr});
        const bool open = forEachLine(text, [&](std::string_view line, int number, bool inComment) {
            const auto included = inComment ? std::nullopt : includedName(line);
            if (included)
                include(*included, file + ":" + std::to_string(number) + ": ");
            else
                add(line, origin, number);
        });
        if (open)
            throw GlError("\"" + file + "\" ends inside a comment.");
    }

    void add(std::string_view line, int origin, int number)
    {
        result_.text += line;
        result_.text += '\n';
        result_.lines.push_back({origin, number});
    }

    const SourceProvider& source_;
    const std::vector<Snippet>& snippets_;
    std::set<std::string, std::less<>> seen_;
    ShaderText result_;
};

} // namespace

ShaderText expandShader(const SourceProvider& source, std::string_view path, const std::string& version, const std::vector<Define>& defines,
                        const std::vector<Snippet>& snippets)
{
    return Expander(source, snippets).run(path, version, defines);
}

void throwCompileError(const ShaderText& shader, const std::string& label, std::string_view log)
{
    const std::vector<DriverMessage> messages = parseDriverLog(log);
    const auto place = [&](const DriverMessage& message) -> std::optional<ShaderText::Line> {
        if (message.line < 1 || static_cast<std::size_t>(message.line) > shader.lines.size())
            return std::nullopt;
        return shader.lines[static_cast<std::size_t>(message.line) - 1];
    };
    const auto originOf = [&](const ShaderText::Line& line) -> const ShaderText::Origin& {
        return shader.origins[static_cast<std::size_t>(line.origin)];
    };
    const auto firstError = std::find_if(messages.begin(), messages.end(), [](const auto& m) { return m.error; });
    if (firstError != messages.end())
        if (const auto at = place(*firstError)) {
            const Snippet* snippet = originOf(*at).snippet;
            if (snippet && snippet->fromDescription)
                throwAt(*snippet, at->line - snippet->firstLine + 1, firstError->column,
                        "the graphics driver can't compile this code: " + firstError->text);
        }
    std::string text = "Shader \"" + label + "\" can't be compiled:";
    for (const DriverMessage& message : messages) {
        text += "\n  ";
        if (const auto at = place(message))
            text += originOf(*at).file + ":" + std::to_string(at->line) + ": ";
        text += message.text;
    }
    if (messages.empty())
        text += " the driver gives no reason.";
    throw GlError(text);
}

} // namespace sky::gl
