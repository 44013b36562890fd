#include "subcommand.hpp"

namespace sky::cli {

std::vector<std::unique_ptr<Subcommand>> makeSubcommands()
{
    std::vector<std::unique_ptr<Subcommand>> all;
    all.push_back(makeDoctor());
    return all;
}

} // namespace sky::cli
