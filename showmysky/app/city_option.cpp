#include "base/angles.hpp"
#include "base/error.hpp"
#include "base/suggest.hpp"
#include "number_text.hpp"
#include "scene_options.hpp"
#include <algorithm>

namespace showmysky::app {

namespace {

using sky::base::degree;

std::vector<std::string_view> pieces(std::string_view text, char separator)
{
    std::vector<std::string_view> result;
    for (;;) {
        const auto end = text.find(separator);
        result.push_back(trimmed(text.substr(0, end)));
        if (end == std::string_view::npos)
            return result;
        text.remove_prefix(end + 1);
    }
}

double numberOf(const std::string& name, std::string_view text, bool length)
{
    double unit = 1;
    std::string_view digits = text;
    if (length && text.size() > 2 && text.substr(text.size() - 2) == "km") {
        unit = 1e3;
        digits = trimmed(text.substr(0, text.size() - 2));
    } else if (length && text.size() > 1 && text.back() == 'm') {
        digits = trimmed(text.substr(0, text.size() - 1));
    }
    const auto value = parseNumber(digits);
    if (!value)
        throw sky::UsageError("The " + name + " of a city is `" + std::string(text) + "`; expected a number" +
                              (length ? " of metres, or of kilometres with km." : "."));
    return *value * unit;
}

CityOption parseCity(std::string_view text)
{
    static const std::vector<std::string> names{"distance", "azimuth", "radius", "luminance", "spectrum"};
    CityOption city;
    double* const values[] = {&city.distance, &city.azimuth, &city.radius, &city.luminance};
    std::vector<std::string> seen;
    for (const auto part : pieces(text, ',')) {
        const auto equals = part.find('=');
        const std::string name(trimmed(part.substr(0, equals)));
        const auto found = std::find(names.begin(), names.end(), name);
        if (equals == std::string_view::npos || found == names.end())
            throw sky::UsageError("`" + std::string(part) +
                                  "` is not understood; expected NAME=VALUE with one of distance, azimuth, radius, "
                                  "luminance, spectrum." +
                                  sky::suggestion(name, names));
        if (std::find(seen.begin(), seen.end(), name) != seen.end())
            throw sky::UsageError("The " + name + " of a city is given twice.");
        seen.push_back(name);
        const auto value = trimmed(part.substr(equals + 1));
        if (name == "spectrum")
            for (const auto each : pieces(value, ':'))
                city.spectrum.push_back(numberOf(name, each, false));
        else
            *values[found - names.begin()] = numberOf(name, value, name == "distance" || name == "radius");
    }
    return city;
}

} // namespace

City CityOption::city() const { return {distance, azimuth * degree, radius, luminance, spectrum}; }

std::vector<CityOption> parseCities(std::string_view text)
{
    std::vector<CityOption> cities;
    for (const auto piece : pieces(text, ';'))
        if (!piece.empty())
            cities.push_back(parseCity(piece));
    return cities;
}

std::string toText(const std::vector<CityOption>& cities)
{
    std::string text;
    for (const auto& city : cities) {
        text += (text.empty() ? "" : "; ") + ("distance=" + toText(city.distance)) + ",azimuth=" + toText(city.azimuth) +
                ",radius=" + toText(city.radius) + ",luminance=" + toText(city.luminance);
        for (std::size_t w = 0; w < city.spectrum.size(); ++w)
            text += (w == 0 ? ",spectrum=" : ":") + toText(city.spectrum[w]);
    }
    return text;
}

} // namespace showmysky::app
