#pragma once
// Shader text before the driver sees it: #include expansion, and the way back from driver messages to files and lines.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace sky::gl {

/// Gives the text of a shader file by its path below shaders/, "lib/geometry.glsl"; empty where there is none.
using SourceProvider = std::function<std::string_view(std::string_view path)>;

/// A `#define NAME VALUE` for all stages of a program.
struct Define {
    std::string name;
    std::string value;
};

/// Text that is not one of our files, included as `#include "user:NAME"`: a code block of a description, a host's function.
struct Snippet {
    std::string name;
    std::string text;
    std::string file;            ///< where it stands, for messages
    int firstLine = 1;           ///< line of `file` on which `text` starts
    bool fromDescription = true; ///< errors in it are AtmoError; otherwise GlError
};

/// One shader, all includes expanded, with what is needed to trace its lines.
///
/// There are no `#line` directives in it: Mesa (seen in 22.3) forgets their source-string number in most messages. Each line of
/// the text remembers instead where it came from, which holds with every driver.
struct ShaderText {
    struct Origin {
        std::string file;
        const Snippet* snippet = nullptr; ///< null for our own files
    };
    struct Line {
        int origin = 0; ///< index in `origins`
        int line = 0;   ///< 1-based line in that file
    };
    std::string text;
    std::vector<Origin> origins;
    std::vector<Line> lines; ///< lines[i]: where line i + 1 of `text` came from
};

/// Joins `#version`, defines and the file `path` with its includes.
///
/// `#include "file"` at the start of a line is replaced by the file, once per shader: later includes of the same file expand
/// to nothing. It is expanded even inside `#if`, so keep it out of those. No other text is changed.
///   version   "430 core", "330 core", "300 es"; for ES, `precision highp` lines follow for floats, integers and samplers; empty: none of
///             them, for text that others put into their shaders
///   snippets  must outlive the result
///   throws    GlError   a missing file or snippet, or an include cycle through the entry file
///             AtmoError a block of a description that could disturb the text around it: an open comment or bracket,
///                       #include, #line, #version or #extension
ShaderText expandShader(const SourceProvider& source, std::string_view path, const std::string& version, const std::vector<Define>& defines,
                        const std::vector<Snippet>& snippets);

/// One message of a driver's log. `source` is -1 and `line` 0 where the driver names no place.
struct DriverMessage {
    int source = -1;
    int line = 0;
    int column = 0; ///< 0 where the driver doesn't say
    bool error = false;
    std::string text;
};

/// Understands Mesa ("0:12(5): error: ..."), NVIDIA ("0(12) : error C1008: ..."), and AMD, Intel, ANGLE and Apple
/// ("ERROR: 0:12: ...").
std::vector<DriverMessage> parseDriverLog(std::string_view log);

/// Turns a compile log into the exception to throw: AtmoError at the place in the description if the first error lies in
/// a block of one, otherwise GlError with every message as `file:line: message`.
[[noreturn]] void throwCompileError(const ShaderText& shader, const std::string& label, std::string_view log);

} // namespace sky::gl
