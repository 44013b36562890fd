#include "ground_light.hpp"

#include <charconv>
#include <cmath>
#include <numbers>
#include <sstream>

#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "base/suggest.hpp"

namespace sky::cli {

std::optional<montecarlo::GroundDisc> readGroundLight(const std::string& option, const std::string& text)
{
    if (text == "all")
        return std::nullopt;
    static const std::vector<std::string> names{"distance", "azimuth", "radius"};
    montecarlo::GroundDisc disc;
    double* const values[] = {&disc.distance, &disc.azimuth, &disc.radius};
    std::stringstream parts(text);
    for (std::string part; std::getline(parts, part, ',');) {
        const auto equals = part.find('=');
        const std::string name = part.substr(0, equals);
        std::size_t which = 0;
        while (which < names.size() && names[which] != name)
            ++which;
        if (equals == std::string::npos || which == names.size())
            throw UsageError(option + ": `" + part + "` is not understood; expected all, or distance=METRES,radius=METRES" +
                             "[,azimuth=DEGREES]." + suggestion(name, names));
        std::string digits = part.substr(equals + 1);
        double unit = which == 1 ? std::numbers::pi / 180 : 1;
        if (which != 1 && digits.size() > 2 && digits.ends_with("km")) {
            digits.resize(digits.size() - 2);
            unit = 1e3;
        }
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), *values[which]);
        if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(*values[which]))
            throw UsageError(option + ": the " + name + " is `" + part.substr(equals + 1) + "`; expected a number" +
                             (which == 1 ? " of degrees." : " of metres, or of kilometres with km."));
        *values[which] *= unit;
    }
    if (!(disc.radius > 0) || disc.distance < 0)
        throw UsageError(option + ": a disc needs a radius above 0 and a distance of at least 0.");
    return disc;
}

std::vector<montecarlo::Result> judgeGroundLight(const montecarlo::Reference& reference, const std::vector<montecarlo::Query>& queries,
                                                 const std::optional<montecarlo::GroundDisc>& disc, const JudgeSettings& settings,
                                                 const std::function<void(double)>& progress)
{
    montecarlo::Settings paths;
    paths.orders = settings.orders;
    paths.relativeError = settings.relativeError;
    paths.seed = settings.seed;
    paths.maxSeconds = settings.seconds / std::max(1., static_cast<double>(queries.size()));
    std::vector<montecarlo::Result> results;
    for (const auto& query : queries) {
        if (interrupted())
            throw Cancelled("Stopped on request.");
        const auto light = reference.groundLight(query, disc, paths);
        montecarlo::Result result;
        result.multiple = light.scattered;
        result.multipleStderr = light.scatteredStderr;
        result.groundDirect = light.direct;
        result.paths = light.paths;
        results.push_back(result);
        progress(static_cast<double>(results.size()) / static_cast<double>(queries.size()));
    }
    return results;
}

} // namespace sky::cli
