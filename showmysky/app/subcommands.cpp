#include "subcommand.hpp"

namespace showmysky::app {

std::vector<std::unique_ptr<Subcommand>> makeSubcommands()
{
    std::vector<std::unique_ptr<Subcommand>> all;
    all.push_back(makeView());
    all.push_back(makeRender());
    all.push_back(makeProbe());
    all.push_back(makeInfo());
    all.push_back(makeMeasure());
    return all;
}

} // namespace showmysky::app
