#include "host_functions.hpp"

#include "gl/shader_text.hpp"
#include "sky_shaders.hpp"

namespace showmysky {

namespace gl = sky::gl;

namespace {

void setUniform(const gl::Api& gl, GLint at, const UniformValue& value)
{
    struct Setter {
        const gl::Api& gl;
        GLint at;
        void operator()(int v) const { gl->Uniform1i(at, v); }
        void operator()(float v) const { gl->Uniform1f(at, v); }
        void operator()(const std::array<float, 2>& v) const { gl->Uniform2fv(at, 1, v.data()); }
        void operator()(const std::array<float, 3>& v) const { gl->Uniform3fv(at, 1, v.data()); }
        void operator()(const std::array<float, 4>& v) const { gl->Uniform4fv(at, 1, v.data()); }
        void operator()(const std::vector<Texel>& v) const { gl->Uniform4fv(at, static_cast<GLsizei>(v.size()), v.front().data()); }
    };
    std::visit(Setter{gl, at}, value);
}

/// The name that shaders/render/host_functions.glsl gives to one of our uniforms.
std::string hostName(std::string name)
{
    name[0] = static_cast<char>(name[0] - 'a' + 'A');
    return "showmysky" + name;
}

} // namespace

HostFunctions::HostFunctions(const gl::Api& api, int scatterers, gl::TextureFormat format)
    : api_(api),
      aerial_(api, "aerial perspective", format, Aerial::azimuths, 2 * Aerial::halfViews, Aerial::tables(scatterers) * Aerial::distances)
{
}

std::string HostFunctions::source(int scatterers)
{
    return gl::expandShader(sky::shaders::source, "render/host_functions.glsl", {}, Painter::lightDefines(scatterers), {}).text;
}

bool HostFunctions::asksForDistances(unsigned program) const
{
    GLint linked = GL_FALSE;
    if (api_->IsProgram(program))
        api_->GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked)
        throw Error(ErrorKind::settings, "There is no linked OpenGL program of number " + std::to_string(program) + ".");
    return api_->GetUniformLocation(program, hostName("aerial").c_str()) >= 0; // drivers drop what a host doesn't use
}

void HostFunctions::set(const Aerial* aerial, const sky::physics::Planet& planet, double altitude, const Illuminance& light)
{
    if (aerial) {
        std::vector<float> values;
        values.reserve(4 * aerial->texels().size());
        for (const Texel& texel : aerial->texels())
            values.insert(values.end(), texel.begin(), texel.end());
        if (aerial_.size().width != aerial->columns())
            aerial_ =
                gl::Texture3D(api_, "aerial perspective", aerial_.format(), aerial->columns(), aerial_.size().height, aerial_.size().depth);
        aerial_.upload(values);
        uniforms_["aerialPlanet"] = std::array<float, 2>{static_cast<float>(planet.radius), static_cast<float>(planet.topOfAtmosphere)};
        uniforms_["aerialAltitude"] = static_cast<float>(altitude);
        uniforms_["aerialSize"] = std::array<float, 3>{static_cast<float>(aerial->columns()), Aerial::halfViews, Aerial::distances};
    }
    uniforms_["horizontalSunlight"] = light.sunHorizontal;
    uniforms_["facingSunlight"] = light.sunFacing;
    uniforms_["horizontalSkylight"] = light.skyHorizontal;
}

void HostFunctions::bind(unsigned program, unsigned firstUnit, const Painter& painter) const
{
    std::vector<std::pair<const char*, const gl::Texture*>> textures{
        {"skyTables", &painter.skyTables()}, {"phases", &painter.phases()}, {"aerial", &aerial_}};
    if (painter.hasCities())
        textures.insert(textures.end(), {{"cityAir", &painter.cityAir()}, {"cityDiscs", &painter.cityDiscs()}});
    const auto unitsUsed = static_cast<unsigned>(textures.size());
    if (firstUnit > static_cast<unsigned>(api_.limits().textureUnits) ||
        firstUnit + unitsUsed > static_cast<unsigned>(api_.limits().textureUnits))
        throw Error(ErrorKind::settings, "The functions need " + std::to_string(unitsUsed) + " texture units from " +
                                             std::to_string(firstUnit) + " on; this context has " +
                                             std::to_string(api_.limits().textureUnits) + ".");
    GLint activeBefore = 0, programBefore = 0;
    api_->GetIntegerv(GL_ACTIVE_TEXTURE, &activeBefore);
    api_->GetIntegerv(GL_CURRENT_PROGRAM, &programBefore);
    api_->UseProgram(program);
    const auto locate = [&](const std::string& name) { return api_->GetUniformLocation(program, hostName(name).c_str()); };
    for (const Uniforms* uniforms : {&painter.lightUniforms(), &uniforms_})
        for (const auto& [name, value] : *uniforms)
            if (const GLint at = locate(name); at >= 0)
                setUniform(api_, at, value);
    unsigned unit = firstUnit;
    for (const auto& [name, texture] : textures) {
        texture->bindUnit(unit);
        api_->BindSampler(unit, 0);
        if (const GLint at = locate(name); at >= 0)
            api_->Uniform1i(at, static_cast<GLint>(unit));
        ++unit;
    }
    // Samplers of different kinds may not share a unit, used or not: without cities theirs look where the sky's tables are.
    if (!painter.hasCities())
        for (const char* name : {"cityAir", "cityDiscs"})
            if (const GLint at = locate(name); at >= 0)
                api_->Uniform1i(at, static_cast<GLint>(firstUnit));
    api_->ActiveTexture(static_cast<GLenum>(activeBefore));
    api_->UseProgram(static_cast<GLuint>(programBefore));
    gl::checkErrors(api_, "binding the functions for hosts");
}

std::size_t HostFunctions::textureBytes() const
{
    return aerial_.size().texels() * (aerial_.format() == gl::TextureFormat::rgba16f ? 8 : 16);
}

} // namespace showmysky
