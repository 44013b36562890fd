#include "atmo/write.hpp"

#include "atmo/keys.hpp"
#include "base/error.hpp"

#include <charconv>

namespace sky::atmo {

namespace {

/// The shortest digits that read back as the same number. Quantities have no exponents in the language as specified.
std::string digits(double value, std::chars_format format)
{
    char buffer[1100]; // the smallest double needs 1077 signs in fixed notation
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value, format);
    if (error != std::errc())
        throw RangeError("a number of the description has too many digits to be written");
    return {buffer, end};
}

std::string quantity(double value, const char* unit) { return digits(value, std::chars_format::fixed) + " " + unit; }

class Writer
{
public:
    explicit Writer(const Description& description) : description_(description) {}

    std::string text()
    {
        Description& d = description_;
        entry(key::version, std::to_string(d.version));
        blankLine();
        for (const LengthKey& key : lengthKeys())
            if (!key.fallback || key.field(d) != *key.fallback)
                entry(key.key, quantity(key.field(d), "m"));
        entry(key::scatteringOrders, d.allScatteringOrders ? "all" : std::to_string(d.scatteringOrders));
        blankLine();
        for (const WholeNumberKey& key : wholeNumberKeys())
            entry(key.key, std::to_string(key.field(d)));
        blankLine();
        entry(key::wavelengths, "min=" + digits(d.wavelengths.minNm, std::chars_format::fixed) +
                                    "nm,max=" + digits(d.wavelengths.maxNm, std::chars_format::fixed) +
                                    "nm,count=" + std::to_string(d.wavelengths.count));
        entry(key::solarIrradiance, list(key::solarIrradiance, d.solarIrradiance));
        entry(key::groundAlbedo, list(key::groundAlbedo, d.groundAlbedo));
        if (!d.lightPollutionRadiance.empty())
            entry(key::lightPollution, list(key::lightPollution, d.lightPollutionRadiance));
        for (const Scatterer& scatterer : d.scatterers)
            write(scatterer);
        for (const Absorber& absorber : d.absorbers)
            write(absorber);
        return std::move(text_);
    }

private:
    void blankLine() { text_ += '\n'; }
    void entry(std::string_view key, const std::string& value)
    {
        text_ += indentation_;
        text_ += key;
        text_ += ": " + value + "\n";
    }

    std::string list(std::string_view key, const Spectrum& spectrum) const
    {
        if (spectrum.size() != static_cast<std::size_t>(description_.wavelengths.count))
            throw RangeError("`" + std::string(key) + "` has " + std::to_string(spectrum.size()) + " values for " +
                             std::to_string(description_.wavelengths.count) + " wavelengths");
        std::string text;
        for (const double value : spectrum)
            text += (text.empty() ? "" : ", ") + digits(value, std::chars_format::general);
        return text;
    }

    void code(std::string_view key, const CodeBlock& block)
    {
        if (block.text.find("```") != std::string::npos || block.text.find_first_of(std::string_view("\r\0", 2)) != std::string::npos)
            throw RangeError("the code block `" + std::string(key) +
                             "` contains ```, a carriage return or a NUL byte and can't be written");
        // Untouched from its first column on, so that it reads back as it was.
        text_ += indentation_ + std::string(key) + ":\n" + indentation_ + "```\n" + block.text + "\n" + indentation_ + "```\n";
    }

    void begin(const char* kind, const std::string& name)
    {
        text_ += "\n" + std::string(kind) + " \"" + name + "\":\n{\n";
        indentation_ = "    ";
    }
    void end()
    {
        indentation_.clear();
        text_ += "}\n";
    }

    void write(const Scatterer& scatterer)
    {
        begin("Scatterer", scatterer.name);
        code(key::numberDensity, scatterer.numberDensity);
        code(key::phaseFunction, scatterer.phaseFunction);
        entry(key::phaseFunctionType, std::string(phaseFunctionTypeNames[static_cast<int>(scatterer.phaseFunctionType)]));
        entry(key::crossSectionAt1um, quantity(scatterer.crossSectionAt1um, "m^2"));
        entry(key::angstromExponent, digits(scatterer.angstromExponent, std::chars_format::general));
        entry(key::singleScatteringAlbedo, list(key::singleScatteringAlbedo, scatterer.singleScatteringAlbedo));
        if (scatterer.needsInterpolationGuides)
            text_ += indentation_ + std::string(key::interpolationGuides) + "\n";
        end();
    }

    void write(const Absorber& absorber)
    {
        begin("Absorber", absorber.name);
        code(key::numberDensity, absorber.numberDensity);
        entry(key::crossSection, list(key::crossSection, absorber.crossSection));
        end();
    }

    Description description_; // a copy, because the accessors of the key tables are for reading and writing
    std::string text_;
    std::string indentation_;
};

} // namespace

std::string write(const Description& description) { return Writer(description).text(); }

} // namespace sky::atmo
