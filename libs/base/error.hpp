#pragma once
// Errors, by who can mend them. The message is complete: what is wrong, what was expected, what to try.

#include <stdexcept>
#include <string>

namespace sky {

/// Base of everything our libraries throw. Only programs print it and choose the exit code.
class Error : public std::runtime_error
{
public:
    using std::runtime_error::runtime_error;
    /// True where the user's input must change (exit code 2), false otherwise (exit code 1).
    virtual bool inputMustChange() const { return false; }
};

/// A command-line option or argument is wrong.
class UsageError : public Error
{
public:
    using Error::Error;
    bool inputMustChange() const override { return true; }
};

/// A place in a text: 1-based line and column (in characters); 0 where unknown.
struct SourceLocation {
    std::string file;
    int line = 0;
    int column = 0;
};

/// The description of the atmosphere is wrong. The message starts with `file:line:column: ` and may end with the
/// offending line and a caret.
class AtmoError : public Error
{
public:
    /// \param place      where
    /// \param message    what is wrong and what was expected, one sentence
    /// \param sourceLine the text of that line, or empty
    AtmoError(const SourceLocation& place, const std::string& message, const std::string& sourceLine = {});
    bool inputMustChange() const override { return true; }
    const SourceLocation& location() const { return place_; }

private:
    SourceLocation place_;
};

/// A model directory can't be read: names the file, the table and what was expected.
class ModelError : public Error
{
public:
    using Error::Error;
    bool inputMustChange() const override { return true; }
};

/// An argument is outside its legal range: names argument, value and range.
class RangeError : public Error
{
public:
    using Error::Error;
    bool inputMustChange() const override { return true; }
};

/// OpenGL failed: names the stage, the object's label and the driver's words.
class GlError : public Error
{
public:
    using Error::Error;
};

/// A stage made a value that is not finite or is negative: names stage, table and the first bad texel.
class NumericsError : public Error
{
public:
    using Error::Error;
};

/// A file can't be read or written: names the file and the system's reason.
class FileError : public Error
{
public:
    using Error::Error;
};

/// The user asked to stop.
class Cancelled : public Error
{
public:
    using Error::Error;
};

} // namespace sky
