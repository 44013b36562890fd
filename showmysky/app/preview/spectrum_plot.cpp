#include "spectrum_plot.hpp"

#include "physics/colour.hpp"
#include <algorithm>
#include <cmath>
#include <imgui.h>

namespace showmysky::app::preview {

namespace {

constexpr float plotWidth = 360, plotHeight = 180, margin = 46;

/// A round number at or above `value`: 1, 2 or 5 times a power of ten.
double roundUp(double value)
{
    const double power = std::pow(10, std::floor(std::log10(value)));
    for (const double factor : {1., 2., 5.})
        if (value <= factor * power)
            return factor * power;
    return 10 * power;
}

/// How a wavelength looks, for the area under the curve.
ImU32 colourOf(double nm)
{
    const auto matching = sky::physics::matchingFunctions(nm);
    const auto rgb = sky::physics::linearSrgb({matching[0], matching[1], matching[2]});
    const auto level = [](double linear) {
        return static_cast<int>(255 * sky::physics::encodeSrgb(std::clamp(0.05 + 0.6 * linear, 0., 1.)));
    };
    return IM_COL32(level(rgb[0]), level(rgb[1]), level(rgb[2]), 255);
}

/// From wavelengths and radiances to points of the window.
struct Axes {
    ImVec2 corner; ///< lower left
    double firstNm, lastNm, largest;

    ImVec2 at(double nm, double radiance) const
    {
        return {corner.x + static_cast<float>((nm - firstNm) / (lastNm - firstNm)) * plotWidth,
                corner.y - static_cast<float>(radiance / largest) * plotHeight};
    }
};

double interpolated(const Reading& reading, double nm)
{
    const auto& x = reading.wavelengths;
    const auto above =
        std::clamp<std::ptrdiff_t>(std::upper_bound(x.begin(), x.end(), nm) - x.begin(), 1, static_cast<std::ptrdiff_t>(x.size()) - 1);
    const auto i = static_cast<std::size_t>(above);
    const double t = (nm - x[i - 1]) / (x[i] - x[i - 1]);
    return reading.radiance[i - 1] + t * (reading.radiance[i] - reading.radiance[i - 1]);
}

void drawAxes(ImDrawList& list, const Axes& axes)
{
    const ImU32 line = IM_COL32(140, 140, 140, 255), text = IM_COL32(200, 200, 200, 255);
    list.AddRect({axes.corner.x, axes.corner.y - plotHeight}, {axes.corner.x + plotWidth, axes.corner.y}, line);
    char label[32];
    for (int nm = 400; nm <= 800; nm += 100)
        if (nm >= axes.firstNm && nm <= axes.lastNm) {
            const ImVec2 foot = axes.at(nm, 0);
            list.AddLine(foot, {foot.x, foot.y + 4}, line);
            std::snprintf(label, sizeof label, "%d nm", nm);
            list.AddText({foot.x - 20, foot.y + 6}, text, label);
        }
    for (int i = 0; i <= 2; ++i) {
        const double value = axes.largest * i / 2;
        const ImVec2 place = axes.at(axes.firstNm, value);
        std::snprintf(label, sizeof label, "%.2g", value);
        list.AddText({place.x - margin, place.y - 7}, text, label);
    }
}

void drawSpectrum(const Reading& reading)
{
    const double most = *std::max_element(reading.radiance.begin(), reading.radiance.end());
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    ImGui::Dummy({plotWidth + margin + 20, plotHeight + 36});
    const Axes axes{{origin.x + margin, origin.y + 8 + plotHeight},
                    reading.wavelengths.front(),
                    reading.wavelengths.back(),
                    most > 0 ? roundUp(most) : 1};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    constexpr int columns = 180;
    for (int i = 0; i < columns; ++i) {
        const double span = axes.lastNm - axes.firstNm;
        const double from = axes.firstNm + span * i / columns, to = axes.firstNm + span * (i + 1) / columns;
        const double middle = (from + to) / 2;
        list.AddRectFilled(axes.at(from, interpolated(reading, middle)), axes.at(to, 0), colourOf(middle));
    }
    std::vector<ImVec2> points;
    for (std::size_t i = 0; i < reading.wavelengths.size(); ++i)
        points.push_back(axes.at(reading.wavelengths[i], reading.radiance[i]));
    list.AddPolyline(points.data(), static_cast<int>(points.size()), IM_COL32(255, 255, 255, 255), 0, 1.5f);
    for (const auto& point : points)
        list.AddCircleFilled(point, 2.5f, IM_COL32(255, 255, 255, 255));
    drawAxes(list, axes);
    const ImVec2 pointer = ImGui::GetIO().MousePos;
    if (ImGui::IsItemHovered() && pointer.x >= axes.corner.x && pointer.x <= axes.corner.x + plotWidth) {
        const double nm = axes.firstNm + static_cast<double>((pointer.x - axes.corner.x) / plotWidth) * (axes.lastNm - axes.firstNm);
        ImGui::SetTooltip("%.1f nm: %.4g", nm, interpolated(reading, nm));
    }
    ImGui::TextUnformatted("W m^-2 sr^-1 nm^-1");
}

void drawMark(float x, float y)
{
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddCircle({x, y}, 6, IM_COL32(0, 0, 0, 200), 0, 3);
    list.AddCircle({x, y}, 6, IM_COL32(255, 255, 255, 255), 0, 1.5f);
}

} // namespace

bool drawReading(const Reading& reading, float markX, float markY)
{
    drawMark(markX, markY);
    bool open = true;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x - 10, 10}, ImGuiCond_FirstUseEver, {1, 0});
    if (ImGui::Begin("Light of a pixel", &open, ImGuiWindowFlags_AlwaysAutoResize)) {
        ImGui::Text("azimuth %.2f, elevation %.2f degrees", reading.azimuth, reading.elevation);
        ImGui::Text("luminance %.5g cd/m^2, scotopic %.5g", static_cast<double>(reading.luminance.y),
                    static_cast<double>(reading.luminance.scotopic));
        if (reading.xy)
            ImGui::Text("CIE 1931 x %.4f, y %.4f", (*reading.xy)[0], (*reading.xy)[1]);
        else
            ImGui::TextUnformatted("black: no chromaticity");
        if (reading.colourTemperature)
            ImGui::Text("correlated colour temperature %.0f K", *reading.colourTemperature);
        else
            ImGui::TextUnformatted("no correlated colour temperature: too far from a black body");
        if (!reading.problem.empty())
            ImGui::TextWrapped("%s", reading.problem.c_str());
        else if (reading.radiance.size() > 1)
            drawSpectrum(reading);
    }
    ImGui::End();
    return open;
}

} // namespace showmysky::app::preview
