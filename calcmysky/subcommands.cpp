#include "subcommand.hpp"

namespace sky::cli {

std::vector<std::unique_ptr<Subcommand>> makeSubcommands()
{
    std::vector<std::unique_ptr<Subcommand>> all;
    all.push_back(makeDoctor());
    all.push_back(makeVerify());
    all.push_back(makeReference());
    return all;
}

} // namespace sky::cli
