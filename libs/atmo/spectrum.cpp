#include "atmo/spectrum.hpp"

#include "atmo/fields.hpp"
#include "atmo/keys.hpp"
#include "atmo/tabulated_spectrum.hpp"
#include "atmo/value.hpp"
#include "base/files.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>

namespace sky::atmo {

namespace {

constexpr std::uintmax_t largestFile = 64u << 20; // bytes
constexpr std::size_t mostWeightedFiles = 64;

// Weights like 0.1 + 0.2 + 0.7 of a white surface may exceed the limit by rounding.
constexpr double roundingAllowance = 1e-12;

std::string shown(double value)
{
    char buffer[32];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 7);
    return error == std::errc() ? std::string(buffer, end) : std::string("?");
}

void checkRange(const SpectrumContext& context, const Entry& entry, Position place, Spectrum& spectrum, SpectrumRange range)
{
    const bool bounded = std::isfinite(range.max);
    for (std::size_t i = 0; i < spectrum.size(); ++i) {
        double& value = spectrum[i];
        if (bounded && value > range.max && value <= range.max * (1 + roundingAllowance))
            value = range.max;
        if (!std::isfinite(value) || value < 0 || value > range.max)
            context.source.fail(place, inBackticks(entry.key) + " is " + shown(value) + " at " +
                                           shown(context.wavelengths.at(static_cast<int>(i))) + " nm; it must be " +
                                           (bounded ? "from 0 to " + shown(range.max) : std::string("a number from 0 up")));
    }
}

Spectrum readList(const SpectrumContext& context, const Entry& entry, SpectrumRange range)
{
    ValueReader reader(context.source, entry);
    Spectrum list;
    const auto count = static_cast<std::size_t>(context.wavelengths.count);
    const std::string expected = "expected " + std::to_string(count) + " numbers, one per wavelength";
    do {
        const Position place = reader.place();
        if (list.size() == count)
            reader.failAt(place, inBackticks(entry.key) + " has more numbers than there are wavelengths; " + expected);
        list.push_back(reader.number());
        checkRange(context, entry, place, list, range);
    } while (reader.accept(','));
    if (!reader.atEnd())
        reader.fail("expected a comma between numbers, found " + inBackticks(reader.peek()));
    if (list.size() < count)
        reader.fail(inBackticks(entry.key) + " has " + std::to_string(list.size()) + (list.size() == 1 ? " number; " : " numbers; ") +
                    expected);
    return list;
}

// `[outside=zero, resample=point]` at the end of a line.
ParseOptions readFileOptions(ValueReader& reader, ParseOptions options)
{
    if (!reader.accept('['))
        return options;
    do {
        const Position place = reader.place();
        const std::string name = comparable(reader.word());
        if (name != "outside" && name != "resample")
            reader.failAt(place, "expected `outside=...` or `resample=...`");
        reader.expect('=', "`" + name + "`");
        const Position valuePlace = reader.place();
        const std::string value = comparable(reader.word());
        if (name == "outside" && value == "error")
            options.outside = OutsideRange::Error;
        else if (name == "outside" && value == "zero")
            options.outside = OutsideRange::Zero;
        else if (name == "outside" && value == "end")
            options.outside = OutsideRange::EndValue;
        else if (name == "resample" && value == "band")
            options.resampling = Resampling::BandAverage;
        else if (name == "resample" && value == "point")
            options.resampling = Resampling::Point;
        else
            reader.failAt(valuePlace, name == "outside" ? "expected `outside=error`, `outside=zero` or `outside=end`"
                                                        : "expected `resample=band` or `resample=point`");
    } while (reader.accept(','));
    reader.expect(']', "the options of the file");
    return options;
}

// A path in double quotes, or all up to the options.
std::string readPath(ValueReader& reader)
{
    const std::string_view all = reader.peek();
    const bool inQuotes = all.starts_with('"');
    std::size_t end = 0;
    if (inQuotes) {
        end = all.find('"', 1);
        if (end == std::string_view::npos)
            reader.fail("the path has no closing quote");
    } else {
        const std::size_t bracket = all.ends_with(']') ? all.rfind('[') : std::string_view::npos;
        end = std::min(bracket, all.size());
    }
    const std::string path(inQuotes ? all.substr(1, end - 1) : trimmed(all.substr(0, end)));
    if (path.empty())
        reader.fail("expected the path of a file");
    reader.skip(inQuotes ? end + 1 : end);
    return path;
}

Spectrum readFile(const SpectrumContext& context, const Entry& entry, ValueReader& reader)
{
    const Position place = reader.place();
    const std::string path = readPath(reader);
    const ParseOptions options = readFileOptions(reader, context.options);
    reader.expectEnd();

    const std::filesystem::path file = context.directory / std::filesystem::path(std::u8string(path.begin(), path.end()));
    std::string text;
    try {
        text = readTextFile(file, largestFile);
    } catch (const FileError& error) {
        context.source.fail(place, "the spectrum of " + inBackticks(entry.key) + ": " + printable(error.what()));
    }
    const TabulatedSpectrum table(Source(text, file.string()));

    const Wavelengths& grid = context.wavelengths;
    const double halfStep = grid.count > 1 ? 0.5 * (grid.maxNm - grid.minNm) / (grid.count - 1) : 0;
    Spectrum values;
    for (const double nm : grid.values()) {
        if (!table.covers(nm) && options.outside == OutsideRange::Error)
            context.source.fail(place, inBackticks(path) + " covers " + shown(table.firstNm()) + " to " + shown(table.lastNm()) +
                                           " nm, but " + shown(nm) + " nm is one of the wavelengths; add `[outside=zero]` or " +
                                           "`[outside=end]` to extend the file by zero or by its end value");
        if (!table.covers(nm) && options.outside == OutsideRange::Zero)
            values.push_back(0);
        else if (!table.covers(nm) || options.resampling == Resampling::Point)
            values.push_back(table.at(nm));
        else
            values.push_back(table.bandMean(nm, halfStep));
    }
    return values;
}

Spectrum readWeightedFile(const SpectrumContext& context, const Entry& entry, ValueReader& reader)
{
    const Position place = reader.place();
    if (comparable(reader.word()) != "file")
        reader.failAt(place, "expected `weighted file WEIGHT PATH`");
    const double weight = reader.number();
    Spectrum spectrum = readFile(context, entry, reader);
    for (double& value : spectrum)
        value *= weight;
    return spectrum;
}

} // namespace

Spectrum readSpectrum(const SpectrumContext& context, const std::vector<const Entry*>& entries, SpectrumRange range)
{
    const Entry& first = *entries.front();
    if (first.kind != Entry::Kind::Value || first.value.empty())
        context.source.fail(first.kind == Entry::Kind::Token ? first.keyPlace : first.valuePlace,
                            inBackticks(first.key) + " needs a spectrum: a list of numbers, `file PATH` or `weighted file WEIGHT PATH`");
    if (entries.size() > mostWeightedFiles)
        context.source.fail(entries[mostWeightedFiles]->keyPlace, inBackticks(first.key) +
                                                                      " is the sum of too many files; expected at most " +
                                                                      std::to_string(mostWeightedFiles));
    Spectrum sum(static_cast<std::size_t>(context.wavelengths.count), 0.0);
    for (const Entry* entry : entries) {
        ValueReader reader(context.source, *entry);
        const char begin = entry->value.front();
        const bool isWord = (begin >= 'a' && begin <= 'z') || (begin >= 'A' && begin <= 'Z');
        if (!isWord)
            return readList(context, *entry, range);
        const Position place = reader.place();
        const std::string form = comparable(reader.word());
        if (form != "file" && form != "weighted")
            reader.failAt(place,
                          "expected a list of numbers, `file PATH` or `weighted file WEIGHT PATH`, found " + inBackticks(entry->value));
        const Spectrum part = form == "file" ? readFile(context, *entry, reader) : readWeightedFile(context, *entry, reader);
        std::transform(sum.begin(), sum.end(), part.begin(), sum.begin(), std::plus<>());
    }
    checkRange(context, first, first.valuePlace, sum, range);
    return sum;
}

} // namespace sky::atmo
