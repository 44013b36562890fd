#pragma once
// What a program may know about the terminal it writes to.

namespace sky {

enum class Stream { Output, Error };

/// True where a person reads the stream, false where it goes into a file or a pipe.
bool isTerminal(Stream stream);

/// Columns of the terminal, 80 where unknown.
int terminalWidth(Stream stream);

/// True where colours are welcome: on a terminal that knows them, with NO_COLOR unset or empty (https://no-color.org).
bool wantsColour(Stream stream);

} // namespace sky
