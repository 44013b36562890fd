#include "panel.hpp"

#include "input.hpp"
#include "scene_fields.hpp"
#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <imgui_stdlib.h>

namespace showmysky::app::preview {

namespace {

constexpr float panelWidth = 340, labelWidth = 145;

/// A number with a slider; Ctrl+click to type.
bool slider(const char* label, double& value, double from, double to, const char* format, bool logarithmic = false)
{
    return ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &from, &to, format,
                               logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
}

/// One of an enumeration, by the names that scene files use.
template<class Enumeration>
bool menu(const char* label, Enumeration& value, const std::vector<std::string>& names)
{
    bool changed = false;
    if (ImGui::BeginCombo(label, names[static_cast<std::size_t>(value)].c_str(), ImGuiComboFlags_HeightLarge)) {
        for (std::size_t i = 0; i < names.size(); ++i)
            if (ImGui::Selectable(names[i].c_str(), i == static_cast<std::size_t>(value))) {
                value = static_cast<Enumeration>(i);
                changed = true;
            }
        ImGui::EndCombo();
    }
    return changed;
}

/// On while the word is in the list; `inverted`: while it is not.
void listSwitch(const char* label, std::vector<std::string>& words, const std::string& word, bool inverted = false)
{
    const auto found = std::find(words.begin(), words.end(), word);
    const bool present = found != words.end();
    bool on = present != inverted;
    if (!ImGui::Checkbox(label, &on))
        return;
    if (present)
        words.erase(found);
    else
        words.push_back(word);
}

void complaint(const std::string& sentence)
{
    if (sentence.empty())
        return;
    ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32(255, 130, 110, 255));
    ImGui::TextWrapped("%s", sentence.c_str());
    ImGui::PopStyleColor();
}

void drawPlaces(SceneOptions& scene, const PanelFacts& facts)
{
    slider("altitude, m", scene.altitude, 0, 1e4 * std::ceil(10 * facts.topOfAtmosphere / 1e4), "%.1f", true);
    slider("Sun, zenith angle", scene.sunZenith, 0, 180, "%.3f");
    slider("Sun, azimuth", scene.sunAzimuth, -180, 180, "%.3f");
    slider("Sun, radius", scene.sunRadius, 0, 5, scene.sunRadius > 0 ? "%.4f" : "of the model");
    ImGui::Separator();
    slider("Moon, zenith angle", scene.moonZenith, 0, 180, "%.3f");
    slider("Moon, azimuth", scene.moonAzimuth, -180, 180, "%.3f");
    double kilometres = scene.moonDistance / 1e3;
    if (slider("Moon, distance, km", kilometres, 3e5, 4.5e5, "%.0f"))
        scene.moonDistance = kilometres * 1e3;
    ImGui::Checkbox("eclipse", &scene.eclipse);
    ImGui::SameLine();
    if (ImGui::Button("Put the Moon on the Sun"))
        putMoonOnSun(scene);
    ImGui::TextWrapped("%s", facts.obscuration.c_str());
    if (!scene.eclipse)
        return;
    complaint(facts.eclipseRefusal);
    if (slider("orders followed", scene.eclipseOrders, 0, 10, scene.eclipseOrders > 0 ? "%.0f" : "all of the model"))
        scene.eclipseOrders = std::round(scene.eclipseOrders);
    bool onTheFly = !scene.precomputedEclipse;
    ImGui::Checkbox("higher orders on the fly", &onTheFly);
    scene.precomputedEclipse = !onTheFly;
    if (scene.precomputedEclipse)
        complaint(facts.eclipseTableNote);
    ImGui::Checkbox("fine tables", &scene.eclipseFine);
    ImGui::SameLine();
    ImGui::Checkbox("limb darkening", &scene.limbDarkening);
}

void drawCamera(SceneOptions& scene)
{
    if (menu("projection", scene.projection, projectionNames()))
        limitFieldOfView(scene);
    if (slider("field of view", scene.fieldOfView, 0.1, 360, "%.2f", true))
        limitFieldOfView(scene);
    slider("yaw", scene.yaw, -180, 180, "%.2f");
    slider("pitch", scene.pitch, -90, 90, "%.2f");
}

void drawLayers(SceneOptions& scene, const PanelFacts& facts)
{
    listSwitch("ground (zero order)", scene.layers, "zero");
    listSwitch("the Sun's disc", scene.layers, "sun");
    listSwitch("single scattering", scene.layers, "single");
    ImGui::Indent();
    for (const auto& name : facts.scatterers)
        listSwitch(name.c_str(), scene.hiddenScatterers, name, true);
    ImGui::Unindent();
    listSwitch("multiple scattering", scene.layers, "multiple");
    slider("light pollution", scene.lightPollution, 0, 100, scene.lightPollution > 0 ? "%.3g cd/m^2" : "off", true);
    if (scene.lightPollution > 0)
        complaint(facts.pollutionRefusal);
    ImGui::Checkbox("pseudo-mirror instead of the ground", &scene.mirror);
}

void drawCities(SceneOptions& scene)
{
    for (std::size_t i = 0; i < scene.cities.size(); ++i) {
        auto& city = scene.cities[i];
        ImGui::PushID(static_cast<int>(i));
        double distance = city.distance / 1e3, radius = city.radius / 1e3;
        if (slider("distance, km", distance, 0, 1000, "%.2f", true))
            city.distance = distance * 1e3;
        slider("azimuth", city.azimuth, -180, 180, "%.2f");
        // Not a slider: light around a city of another radius takes seconds to prepare.
        if (ImGui::InputDouble("radius, km", &radius, 1, 0, "%.2f", ImGuiInputTextFlags_EnterReturnsTrue))
            city.radius = std::clamp(radius, 0.1, 100.) * 1e3;
        slider("luminance, cd/m^2", city.luminance, 0, 100, "%.3g", true);
        const bool remove = ImGui::Button("Remove");
        ImGui::Separator();
        ImGui::PopID();
        if (remove)
            scene.cities.erase(scene.cities.begin() + static_cast<std::ptrdiff_t>(i--));
    }
    if (ImGui::Button("Add a city"))
        addCity(scene);
}

void drawSun(SceneOptions& scene)
{
    static const std::vector<std::string> kinds{"as the model says", "flat", "black body", "factors of the scene"};
    using Kind = SolarSpectrum::Kind;
    auto& spectrum = scene.solarSpectrum;
    auto offered = kinds;
    if (spectrum.factors.empty())
        offered.pop_back(); // factors come from files
    menu("solar spectrum", spectrum.kind, offered);
    if (spectrum.kind == Kind::blackBody)
        slider("temperature, K", spectrum.temperature, 1000, 40000, "%.0f", true);
}

void drawTables(SceneOptions& scene, const PanelFacts& facts)
{
    bool textures = scene.source == Source::textures;
    if (ImGui::Checkbox("from 4D textures", &textures))
        scene.source = textures ? Source::textures : Source::moments;
    if (textures)
        complaint(facts.texturesRefusal);
    ImGui::Checkbox("single scattering on the fly", &scene.onTheFly);
    if (scene.onTheFly)
        complaint(facts.onTheFlyRefusal);
    bool filtered = !scene.unfiltered;
    ImGui::Checkbox("texture filtering", &filtered);
    scene.unfiltered = !filtered;
}

void drawDevelopment(Development& development, const PanelFacts& facts)
{
    if (development.automatic)
        development.exposure = facts.exposure; // the slider goes on from there
    ImGui::Checkbox("automatic exposure", &development.automatic);
    if (slider("log exposure", development.exposure, -10, 6, "%.2f"))
        development.automatic = false;
    menu("colours", development.colours, colourModeNames());
    menu("tone mapping", development.curve, toneCurveNames());
    ImGui::Checkbox("gradual clipping", &development.gradualClipping);
    slider("glare", development.glare, 0, 5, development.glare > 0 ? "%.2f" : "off");
    menu("dithering", development.dithering, ditheringNames());
    menu("depth", development.depth, depthNames());
}

PanelWishes drawFiles(State& state, const PanelFacts& facts)
{
    PanelWishes wishes;
    ImGui::TextWrapped("%s", facts.model.empty() ? "Drop a model or a .atmo file here." : facts.model.c_str());
    wishes.reload = ImGui::Button("Reload (R)");
    ImGui::InputText("scene file", &state.sceneFile);
    wishes.save = ImGui::Button("Save scene");
    ImGui::SameLine();
    wishes.load = ImGui::Button("Load scene");
    if (!facts.note.empty())
        ImGui::TextWrapped("%s", facts.note.c_str());
    return wishes;
}

void drawStatusLine(const PanelFacts& facts)
{
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({panelWidth, screen.y}, ImGuiCond_Always, {0, 1});
    ImGui::SetNextWindowSize({std::max(1.f, screen.x - panelWidth), 0});
    ImGui::Begin("##status", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::Text("frame %.1f ms (sky %.1f, screen %.1f)", 1e3 * facts.frameSeconds, 1e3 * facts.skySeconds, 1e3 * facts.screenSeconds);
    if (!facts.activity.empty()) {
        ImGui::SameLine();
        ImGui::ProgressBar(static_cast<float>(facts.fraction), {80, 0});
        ImGui::SameLine();
        ImGui::TextUnformatted(facts.activity.c_str());
    }
    complaint(facts.refusal);
    ImGui::End();
}

} // namespace

PanelWishes drawPanel(State& state, const PanelFacts& facts)
{
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({panelWidth, ImGui::GetIO().DisplaySize.y});
    ImGui::Begin("Scene", nullptr,
                 ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoTitleBar |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::PushItemWidth(panelWidth - labelWidth - 30);
    const auto section = [](const char* name) { return ImGui::CollapsingHeader(name, ImGuiTreeNodeFlags_DefaultOpen); };
    PanelWishes wishes;
    if (section("Model and scene"))
        wishes = drawFiles(state, facts);
    if (section("Camera"))
        drawCamera(state.scene);
    if (section("Sun, Moon, altitude"))
        drawPlaces(state.scene, facts);
    if (section("Picture"))
        drawDevelopment(state.scene.development, facts);
    if (section("Light")) {
        drawLayers(state.scene, facts);
        drawSun(state.scene);
    }
    if (section("Tables"))
        drawTables(state.scene, facts);
    if (section("Cities"))
        drawCities(state.scene);
    ImGui::Separator();
    ImGui::TextWrapped("Shift or right drag: turn. Ctrl+drag: the Sun. Ctrl+right drag: the Moon. Wheel: zoom. "
                       "Click: the light of a pixel. Tab: hide all this.");
    ImGui::PopItemWidth();
    ImGui::End();
    drawStatusLine(facts);
    return wishes;
}

void drawNotice(const PanelFacts& facts, bool hasPicture)
{
    if (facts.problem.empty() && (hasPicture || facts.activity.empty()))
        return;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({(screen.x + panelWidth) / 2, screen.y / 3}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::Begin("##notice", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PushTextWrapPos(std::max(300.f, screen.x - panelWidth - 60));
    if (!facts.problem.empty())
        complaint(facts.problem);
    else
        ImGui::TextUnformatted((facts.activity + " ...").c_str());
    ImGui::PopTextWrapPos();
    ImGui::End();
}

} // namespace showmysky::app::preview
