#include "interface.hpp"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <utility>

namespace showmysky::app::preview {

Interface::Interface(const Window& window) : context_(ImGui::CreateContext())
{
    ImGui::GetIO().IniFilename = nullptr; // what is worth keeping is in our preferences
    ImGui::GetStyle().WindowRounding = 3;
    ImGui::GetStyle().Colors[ImGuiCol_WindowBg].w = 0.88f;
    ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
    ImGui_ImplOpenGL3_Init("#version 330 core");
}

Interface::~Interface()
{
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext(context_);
}

void Interface::begin(const std::vector<Event>& events)
{
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    std::optional<Point> place = std::exchange(release_, std::nullopt);
    bool pressed = false;
    for (const auto& event : events) {
        if (const auto* press = std::get_if<ButtonPressed>(&event)) {
            place = press->at;
            pressed = true;
        } else if (const auto* release = std::get_if<ButtonReleased>(&event)) {
            (pressed ? release_ : place) = release->at;
        }
    }
    if (place)
        ImGui::GetIO().MousePos = {static_cast<float>(place->x), static_cast<float>(place->y)};
    ImGui::NewFrame();
}

void Interface::end()
{
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool Interface::wantsPointer() const { return ImGui::GetIO().WantCaptureMouse; }

bool Interface::wantsKeys() const { return ImGui::GetIO().WantTextInput; }

} // namespace showmysky::app::preview
