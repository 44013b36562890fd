#include "atmo/parse.hpp"

#include "atmo/fields.hpp"
#include "atmo/keys.hpp"
#include "atmo/spectrum.hpp"
#include "atmo/value.hpp"
#include "base/files.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace sky::atmo {

namespace {

constexpr std::uintmax_t largestDescription = 16u << 20; // bytes
constexpr std::size_t longestName = 64;
constexpr std::int64_t mostScatteringTexels = std::int64_t{1} << 30;
// What tables of floats can hold, times sharp phase functions and luminous efficacies; far beyond any star and any particle.
constexpr double mostIrradiance = 1e20;  // W m^-2 nm^-1
constexpr double mostCrossSection = 1e6; // m^2

std::string fromTo(int min, int max) { return "from " + std::to_string(min) + " to " + std::to_string(max); }

class Parser
{
public:
    Parser(const Source& source, const std::filesystem::path& directory, const ParseOptions& options)
        : source_(source), entries_(readEntries(source)), spectra_{source, description_.wavelengths, directory, options}
    {
    }

    Description description()
    {
        readVersion();
        std::vector<std::reference_wrapper<const Entry>> plain;
        for (const Entry& entry : entries_)
            if (!speciesKind(entry))
                plain.emplace_back(entry);
        std::vector<std::string_view> ofSections(scattererKeys().begin(), scattererKeys().end());
        ofSections.insert(ofSections.end(), absorberKeys().begin(), absorberKeys().end());
        const Fields fields(source_, std::move(plain), "a description", topLevelKeys(), ofSections);
        requireKeys(fields, mandatoryTopLevelKeys(), "the description", {source_.lineCount(), 0});

        for (const LengthKey& key : lengthKeys())
            readLength(fields, key);
        for (const WholeNumberKey& key : wholeNumberKeys())
            readWholeNumber(fields, key);
        checkScatteringSize(fields);
        readScatteringOrders(valueOf(fields, key::scatteringOrders));
        readWavelengths(valueOf(fields, key::wavelengths));

        description_.solarIrradiance = readSpectrum(spectra_, fields.all(key::solarIrradiance), {mostIrradiance});
        description_.groundAlbedo = readSpectrum(spectra_, fields.all(key::groundAlbedo), {1});
        if (fields.find(key::lightPollution))
            description_.lightPollutionRadiance = readSpectrum(spectra_, fields.all(key::lightPollution), {mostIrradiance});
        for (const Entry& entry : entries_)
            readSpecies(entry);
        return std::move(description_);
    }

private:
    enum class SpeciesKind { Scatterer, Absorber };

    // What a key like `Scatterer "dust"` announces.
    static std::optional<SpeciesKind> speciesKind(const Entry& entry)
    {
        const std::string word = comparable(entry.key.substr(0, entry.key.find_first_of(" \t\"")));
        if (word == "scatterer")
            return SpeciesKind::Scatterer;
        if (word == "absorber")
            return SpeciesKind::Absorber;
        return {};
    }

    static std::vector<std::string_view> mandatoryTopLevelKeys()
    {
        std::vector<std::string_view> keys{key::scatteringOrders, key::wavelengths, key::solarIrradiance, key::groundAlbedo};
        for (const LengthKey& entry : lengthKeys())
            if (!entry.fallback)
                keys.push_back(entry.key);
        return keys;
    }

    void requireKeys(const Fields& fields, const std::vector<std::string_view>& keys, const std::string& where, Position place)
    {
        std::string missing;
        for (const std::string_view key : keys)
            if (!fields.find(key))
                missing += (missing.empty() ? "`" : ", `") + std::string(key) + "`";
        if (!missing.empty())
            source_.fail(place, where + " has no " + missing + "; there is no default for physics");
    }

    // An entry that must be `key: value` on one line.
    const Entry& plainValue(const Entry& entry) const
    {
        if (entry.kind == Entry::Kind::Token)
            source_.fail(entry.keyPlace, inBackticks(entry.key) + " has no value; expected a colon and a value after it");
        if (entry.kind != Entry::Kind::Value)
            source_.fail(entry.valuePlace, inBackticks(entry.key) + " takes a value on the same line, not a block");
        return entry;
    }
    const Entry& valueOf(const Fields& fields, std::string_view key) const { return plainValue(*fields.find(key)); }

    void readVersion()
    {
        const std::string expected = "expected `version: " + std::to_string(supportedVersion) + "` as the first entry";
        if (entries_.empty())
            source_.fail({source_.lineCount(), 0}, "the description is empty; " + expected);
        const Entry& first = entries_.front();
        if (comparable(first.key) != comparable(key::version))
            source_.fail(first.keyPlace, expected + ", found " + inBackticks(first.key));
        ValueReader reader(source_, plainValue(first));
        const Position place = reader.place();
        description_.version = reader.wholeNumber();
        reader.expectEnd();
        if (description_.version != supportedVersion)
            source_.fail(place, "version " + std::to_string(description_.version) + " of the language is not supported; " + expected);
    }

    void readLength(const Fields& fields, const LengthKey& key)
    {
        double& field = key.field(description_);
        const Entry* entry = fields.find(key.key);
        if (!entry) {
            field = *key.fallback; // mandatory keys are known to be there
            return;
        }
        ValueReader reader(source_, plainValue(*entry));
        field = reader.quantity(Dimension::Length);
        reader.expectEnd();
        // 1e-9: the ends of a range belong to it whatever unit they were written in.
        if (!(field >= key.min * (1 - 1e-9) && field <= key.max * (1 + 1e-9)))
            source_.fail(entry->valuePlace,
                         inBackticks(key.key) + " is " + inBackticks(entry->value) + "; it must be " + std::string(key.range));
    }

    void readWholeNumber(const Fields& fields, const WholeNumberKey& key)
    {
        int& field = key.field(description_);
        field = key.fallback;
        const Entry* entry = fields.find(key.key);
        if (!entry)
            return;
        ValueReader reader(source_, plainValue(*entry));
        field = reader.wholeNumber();
        reader.expectEnd();
        if (field < key.min || field > key.max || (key.even && field % 2 != 0))
            source_.fail(entry->valuePlace, inBackticks(key.key) + " is " + inBackticks(entry->value) + "; it must be " +
                                                (key.even ? "even and " : "") + fromTo(key.min, key.max));
    }

    void checkScatteringSize(const Fields& fields)
    {
        const SizeScattering& size = description_.scatteringSize;
        const std::int64_t texels = std::int64_t{size.viewZenithAngle} * size.dotViewSun * size.sunZenithAngle;
        if (texels <= mostScatteringTexels / size.altitude)
            return;
        // One of the four keys is there, or the defaults would fit.
        Position place;
        for (const WholeNumberKey& key : wholeNumberKeys())
            if (key.key.starts_with("scattering texture"))
                if (const Entry* entry = fields.find(key.key))
                    place = entry->valuePlace;
        source_.fail(place, "the four scattering texture sizes multiply to more than 2^30 texels; expected smaller ones");
    }

    void readScatteringOrders(const Entry& entry)
    {
        ValueReader reader(source_, entry);
        if (comparable(entry.value) == "all") {
            description_.allScatteringOrders = true;
            return;
        }
        const std::string range = "`scattering orders` must be " + fromTo(1, mostScatteringOrders) + " or `all`";
        if (reader.peek().empty() || reader.peek().find_first_not_of("+-0123456789") == 0)
            reader.fail(range + ", found " + inBackticks(entry.value));
        description_.scatteringOrders = reader.wholeNumber();
        reader.expectEnd();
        if (description_.scatteringOrders < 1 || description_.scatteringOrders > mostScatteringOrders)
            source_.fail(entry.valuePlace, range + ", found " + inBackticks(entry.value));
    }

    void readWavelengths(const Entry& entry)
    {
        ValueReader reader(source_, entry);
        const std::string form = "expected `min=LENGTH, max=LENGTH, count=NUMBER`";
        std::optional<double> minNm, maxNm;
        std::optional<int> count;
        do {
            const Position place = reader.place();
            const std::string name = comparable(reader.word());
            if (name != "min" && name != "max" && name != "count")
                reader.failAt(place, form);
            if ((name == "min" && minNm) || (name == "max" && maxNm) || (name == "count" && count))
                reader.failAt(place, "`" + name + "` was given before; " + form);
            reader.expect('=', "`" + name + "`");
            if (name == "count")
                count = reader.wholeNumber();
            else
                (name == "min" ? minNm : maxNm) = reader.quantity(Dimension::Length, 9);
        } while (reader.accept(','));
        reader.expectEnd();
        if (!minNm || !maxNm || !count)
            source_.fail(entry.valuePlace, "`wavelengths` is incomplete; " + form);
        if (!(*minNm >= 10 && *maxNm <= 100e3))
            source_.fail(entry.valuePlace, "the wavelengths must be from 10 nm to 100 um");
        if (*count < 1 || *count > mostWavelengths)
            source_.fail(entry.valuePlace,
                         "the count of wavelengths is " + std::to_string(*count) + "; it must be " + fromTo(1, mostWavelengths));
        if (*count == 1 ? *minNm != *maxNm : !(*minNm < *maxNm))
            source_.fail(entry.valuePlace, *count == 1 ? "one wavelength needs `min` and `max` to be equal"
                                                       : "`min` must be smaller than `max` where `count` is more than 1");
        description_.wavelengths = {*minNm, *maxNm, *count};
    }

    void readSpecies(const Entry& entry)
    {
        const std::optional<SpeciesKind> kind = speciesKind(entry);
        if (!kind)
            return;
        const std::string name = speciesName(entry);
        if (entry.kind != Entry::Kind::Section)
            source_.fail(entry.kind == Entry::Kind::Token ? entry.keyPlace : entry.valuePlace,
                         inBackticks(entry.key) + " needs a section: a colon, then `{` on the next line");
        if (*kind == SpeciesKind::Scatterer)
            description_.scatterers.push_back(readScatterer(entry, name));
        else
            description_.absorbers.push_back(readAbsorber(entry, name));
    }

    std::string speciesName(const Entry& entry)
    {
        std::string_view name = entry.key;
        const std::size_t wordEnd = std::min(name.find_first_of(" \t\""), name.size());
        const std::string word(name.substr(0, wordEnd));
        name = trimmed(name.substr(wordEnd));
        if (name.size() < 2 || !name.starts_with('"') || !name.ends_with('"'))
            source_.fail(entry.keyPlace, "expected a name in double quotes, like `" + word + " \"molecules\":`");
        name = trimmed(name.substr(1, name.size() - 2));
        const Position place{entry.keyPlace.line, entry.keyPlace.offset + static_cast<std::size_t>(name.data() - entry.key.data())};
        const bool legal = std::all_of(name.begin(), name.end(), [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
        });
        if (name.empty() || name.size() > longestName || !legal)
            source_.fail(place, inBackticks(name) + " can't be the name of a species; expected 1 to " + std::to_string(longestName) +
                                    " letters (a-z, A-Z), digits and underscores");
        // Tables of the model are files named after the species, and some file systems don't tell small from capital.
        const auto lower = [](std::string_view text) {
            std::string result(text);
            for (char& c : result)
                c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
            return result;
        };
        for (const std::string& earlier : names_)
            if (lower(earlier) == lower(name))
                source_.fail(place, "there is a species `" + earlier +
                                        "` already; expected another name (small and capital letters count as equal)");
        if (names_.size() == static_cast<std::size_t>(mostSpecies))
            source_.fail(place, "too many species; expected at most " + std::to_string(mostSpecies));
        names_.emplace_back(name);
        return names_.back();
    }

    Fields speciesFields(const Entry& section, const std::string& where, std::span<const std::string_view> known,
                         std::span<const std::string_view> mandatory)
    {
        std::vector<std::reference_wrapper<const Entry>> inside(section.entries.begin(), section.entries.end());
        Fields fields(source_, std::move(inside), where, known, topLevelKeys());
        requireKeys(fields, {mandatory.begin(), mandatory.end()}, inBackticks(section.key), section.keyPlace);
        return fields;
    }

    CodeBlock codeOf(const Fields& fields, std::string_view key) const
    {
        const Entry& entry = *fields.find(key);
        if (entry.kind != Entry::Kind::Code)
            source_.fail(entry.kind == Entry::Kind::Token ? entry.keyPlace : entry.valuePlace,
                         inBackticks(entry.key) + " needs a code block: lines of GLSL between two lines of ```");
        if (entry.code.text.find_first_not_of(" \t\n") == std::string::npos)
            source_.fail(entry.valuePlace, "the code block of " + inBackticks(entry.key) + " is empty; expected GLSL that returns a value");
        return entry.code;
    }

    Scatterer readScatterer(const Entry& section, const std::string& name)
    {
        static constexpr std::string_view mandatory[] = {key::numberDensity, key::phaseFunction, key::crossSectionAt1um,
                                                         key::angstromExponent};
        const Fields fields = speciesFields(section, "a scatterer", scattererKeys(), mandatory);
        Scatterer scatterer;
        scatterer.name = name;
        scatterer.numberDensity = codeOf(fields, key::numberDensity);
        scatterer.phaseFunction = codeOf(fields, key::phaseFunction);
        if (const Entry* entry = fields.find(key::phaseFunctionType))
            scatterer.phaseFunctionType = readPhaseFunctionType(plainValue(*entry));
        scatterer.crossSectionAt1um = readCrossSection(valueOf(fields, key::crossSectionAt1um));
        scatterer.angstromExponent = readAngstromExponent(valueOf(fields, key::angstromExponent));
        if (fields.find(key::singleScatteringAlbedo))
            scatterer.singleScatteringAlbedo = readSpectrum(spectra_, fields.all(key::singleScatteringAlbedo), {1});
        else
            scatterer.singleScatteringAlbedo.assign(static_cast<std::size_t>(description_.wavelengths.count), 1.0);
        if (const Entry* entry = fields.find(key::interpolationGuides)) {
            if (entry->kind != Entry::Kind::Token)
                source_.fail(entry->keyPlace, "`needs interpolation guides` takes no value; expected it alone, without a colon");
            scatterer.needsInterpolationGuides = true;
        }
        return scatterer;
    }

    PhaseFunctionType readPhaseFunctionType(const Entry& entry) const
    {
        const auto* const found = std::find(std::begin(phaseFunctionTypeNames), std::end(phaseFunctionTypeNames), comparable(entry.value));
        if (found == std::end(phaseFunctionTypeNames))
            source_.fail(entry.valuePlace,
                         "`phase function type` must be `general`, `achromatic` or `smooth`, found " + inBackticks(entry.value));
        return static_cast<PhaseFunctionType>(found - std::begin(phaseFunctionTypeNames));
    }

    double readCrossSection(const Entry& entry) const
    {
        ValueReader reader(source_, entry);
        const double value = reader.quantity(Dimension::Area);
        reader.expectEnd();
        if (!(value >= 0 && value <= mostCrossSection))
            source_.fail(entry.valuePlace, "`cross section at 1 um` is " + inBackticks(entry.value) + "; it must be from 0 m^2 to 1 km^2");
        return value;
    }

    double readAngstromExponent(const Entry& entry) const
    {
        ValueReader reader(source_, entry);
        const double value = reader.number();
        reader.expectEnd();
        if (!(value >= -20 && value <= 20))
            source_.fail(entry.valuePlace, "`angstrom exponent` is " + inBackticks(entry.value) + "; it must be from -20 to 20");
        return value;
    }

    Absorber readAbsorber(const Entry& section, const std::string& name)
    {
        const Fields fields = speciesFields(section, "an absorber", absorberKeys(), absorberKeys());
        return {name, codeOf(fields, key::numberDensity), readSpectrum(spectra_, fields.all(key::crossSection), {mostCrossSection})};
    }

    const Source& source_;
    std::vector<Entry> entries_;
    Description description_;
    SpectrumContext spectra_;
    std::vector<std::string> names_;
};

} // namespace

Description parse(std::string_view text, const std::string& fileName, const std::filesystem::path& directory, const ParseOptions& options)
{
    if (text.size() > largestDescription)
        throw AtmoError({fileName, 0, 0}, "the description is larger than 16 MB; expected a text written by a person");
    const Source source(text, fileName);
    return Parser(source, directory, options).description();
}

Description parseFile(const std::filesystem::path& path, const ParseOptions& options)
{
    return parse(readTextFile(path, largestDescription), path.string(), path.parent_path(), options);
}

} // namespace sky::atmo
