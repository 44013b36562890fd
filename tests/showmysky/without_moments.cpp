// What a model without moments lacks is said when it is loaded.

#include "sky_for_tests.hpp"
#include <algorithm>
#include <catch2/catch.hpp>

using namespace showmysky;
using namespace showmysky::testing;

TEST_CASE("without moments: loading warns that the sky doesn't light the ground, and with them or one order it does not", "[gl]")
{
    const sky::gl::HeadlessContext context(desktop());
    const auto warned = [&](const char* model) {
        std::vector<std::string> warnings;
        Options options;
        options.log = [&](const std::string& text) { warnings.push_back(text); };
        Sky(model, context.loader(), options).loadAll();
        return std::any_of(warnings.begin(), warnings.end(),
                           [](const std::string& text) { return text.find("no moments") != std::string::npos; });
    };
    CHECK(warned(SHOWMYSKY_TEXTURE_MODEL "-alone"));
    CHECK(!warned(SHOWMYSKY_TEXTURE_MODEL));
    CHECK(!warned(SHOWMYSKY_ONE_ORDER));
}
