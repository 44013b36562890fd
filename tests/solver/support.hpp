#pragma once
// Whole runs on scenes small enough for a software driver: a description made from few words, solved into a directory
// of its own.

#include "../gl/context_for_tests.hpp"
#include "../model/support.hpp"
#include "atmo/parse.hpp"
#include "model/model.hpp"
#include "solver/solve.hpp"
#include <cmath>
#include <set>

namespace sky::solver::test {

using model::test::Scratch;

/// What varies between the scenes; the rest is as small as the language allows.
struct SceneText {
    std::string radius = "6371 km", top = "100 km", sun = "1 AU", orders = "3", albedo = "0.3";
    double minNm = 400, maxNm = 700;
    int wavelengths = 2;
    std::string views = "4", azimuths = "2", suns = "4", altitudes = "2";
    std::string species = rayleigh();

    static std::string scatterer(const std::string& name, const std::string& density, const std::string& phase, const std::string& type,
                                 const std::string& crossSection, const std::string& more = "")
    {
        return "Scatterer \"" + name + "\":\n{\n  number density:\n  ```\n  return " + density +
               ";\n  ```\n  phase function:\n  ```\n  return " + phase + ";\n  ```\n  phase function type: " + type +
               "\n  cross section at 1 um: " + crossSection + "\n  angstrom exponent: 0\n  " + more + "\n}\n";
    }
    /// Optical depth 0.12 along the vertical, at all wavelengths.
    static std::string rayleigh(const std::string& density = "1.5e24*exp(-altitude/(8.0*km))")
    {
        return scatterer("air", density, "vec4(3.0/(16.0*PI)*(1.0+sqr(dotViewSun)))", "smooth", "10 fm^2");
    }
    /// Optical depth 0.05; more forward than back, differently at each wavelength.
    static std::string dust(const std::string& type = "general", const std::string& more = "")
    {
        return scatterer("dust", "5e5*exp(-altitude/(1.0*km))", "(1.0+vec4(0.5)*dotViewSun*wavelengths/700.0)/(4.0*PI)", type, "100 um^2",
                         more);
    }
    std::string all(const std::string& value) const // a spectrum of equal values
    {
        std::string list = value;
        for (int w = 1; w < wavelengths; ++w)
            list += ", " + value;
        return list;
    }
    std::string absorber() const
    {
        return "Absorber \"smoke\":\n{\n  number density:\n  ```\n  return 1e5*exp(-altitude/(8.0*km));\n  ```\n  "
               "cross section: " +
               all("1e-10") + "\n}\n";
    }
    std::string text() const
    {
        return "version: 6\nEarth radius: " + radius + "\natmosphere height: " + top + "\nEarth-Sun distance: " + sun +
               "\nEarth-Moon distance: 384400 km\nscattering orders: " + orders + "\nwavelengths: min=" + std::to_string(minNm) +
               " nm, max=" + std::to_string(maxNm) + " nm, count=" + std::to_string(wavelengths) +
               "\nsolar irradiance at TOA: " + all("1.5") + "\nground albedo: " + all(albedo) +
               "\nscattering texture size for VZA: " + views + "\nscattering texture size for dot(view,sun): " + azimuths +
               "\nscattering texture size for SZA: " + suns + "\nscattering texture size for altitude: " + altitudes +
               "\ntransmittance texture size for VZA: 4\ntransmittance texture size for altitude: 3\n"
               "irradiance texture size for SZA: 4\nirradiance texture size for altitude: 2\n"
               "eclipsed double scattering texture size for VZA: 4\neclipsed double scattering texture size for SZA: 2\n"
               "eclipsed double scattering texture size for relative azimuth: 3\n" +
               species;
    }
    atmo::Description parse() const { return atmo::parse(text(), "scene.atmo", "."); }
};

/// Keeps what it is told, and stops the run in a stage by that name.
struct Listener : Progress {
    std::string stopIn;
    std::vector<std::string> stages, warnings;
    double fraction = 0;
    bool fell = false;
    void stage(const std::string& name, double done) override
    {
        stages.push_back(name);
        advance(done);
    }
    void advance(double done) override
    {
        fell = fell || done < fraction - 1e-12 || !(done <= 1);
        fraction = done;
    }
    bool cancelled() const override { return !stopIn.empty() && !stages.empty() && stages.back() == stopIn; }
    void warning(const std::string& sentence) override { warnings.push_back(sentence); }
};

inline Options draft()
{
    Options options;
    options.quality = "draft";
    return options;
}

inline std::set<std::string> tableNames(const model::Model& model)
{
    std::set<std::string> names;
    for (const auto& table : model.tables())
        names.insert(table.name);
    return names;
}

/// A run with its result.
struct Run {
    Scratch scratch;
    Listener listener;
    model::Model model;
    Run(gl::HeadlessContext& context, const atmo::Description& description, const Options& options = draft())
        : model(solved(context, description, options))
    {
    }
    bool has(const std::string& table) const { return model.hasTable(table); }

private:
    model::Model solved(gl::HeadlessContext& context, const atmo::Description& description, const Options& options)
    {
        solve(description, options, context, scratch.path / "m", listener);
        return model::Model::open(scratch.path / "m");
    }
};

/// Finite and, but for signed tables, not negative: every value of every table.
inline void checkValues(const model::Model& model)
{
    for (const auto& table : model.tables()) {
        int bad = 0;
        for (const float value : model.readAll(table.name))
            bad += !std::isfinite(value) || (!table.isSigned && value < 0);
        INFO(table.name);
        CHECK(bad == 0);
    }
}

} // namespace sky::solver::test
