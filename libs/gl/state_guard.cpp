#include "gl/state_guard.hpp"

#include <algorithm>

namespace sky::gl {

namespace {

/// Targets with one binding and no indices, with the name of the query for it.
constexpr std::array<std::array<GLenum, 2>, 5> plainBufferTargets{{
    {GL_ARRAY_BUFFER, GL_ARRAY_BUFFER_BINDING},
    {GL_COPY_READ_BUFFER, GL_COPY_READ_BUFFER}, // the query is the target itself
    {GL_COPY_WRITE_BUFFER, GL_COPY_WRITE_BUFFER},
    {GL_PIXEL_PACK_BUFFER, GL_PIXEL_PACK_BUFFER_BINDING},
    {GL_PIXEL_UNPACK_BUFFER, GL_PIXEL_UNPACK_BUFFER_BINDING},
}};

constexpr std::array<GLenum, 6> blendQueries{GL_BLEND_SRC_RGB,   GL_BLEND_DST_RGB,      GL_BLEND_SRC_ALPHA,
                                             GL_BLEND_DST_ALPHA, GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA};

GLint integer(const Api& gl, GLenum what)
{
    GLint value = 0;
    gl->GetIntegerv(what, &value);
    return value;
}

void setSwitch(const Api& gl, GLenum what, bool on)
{
    if (on)
        gl->Enable(what);
    else
        gl->Disable(what);
}

GLuint unsignedName(GLint name) { return static_cast<GLuint>(name); }

} // namespace

StateGuard::StateGuard(const Api& api, const GuardedBindings& bindings)
    : api_(api), indexedBlend_(!api.isEs()), indexedFunctions_(!api.isEs() && api.atLeast(4, 0)),
      indexedViewports_(!api.isEs() && api.atLeast(4, 1))
{
    for (int i = 0; i < 8 && api_->GetError() != GL_NO_ERROR; ++i) {
    }
    saveSwitches();
    saveFixedFunction();
    saveBindings(bindings);
}

StateGuard::~StateGuard()
{
    if (!api_.alive())
        return;
    restoreBindings();
    restoreFixedFunction();
    for (const auto& [what, on] : switches_)
        setSwitch(api_, what, on);
}

void StateGuard::saveSwitches()
{
    std::vector<GLenum> names{GL_DEPTH_TEST,      GL_STENCIL_TEST,        GL_CULL_FACE,         GL_DITHER, GL_SAMPLE_ALPHA_TO_COVERAGE,
                              GL_SAMPLE_COVERAGE, GL_POLYGON_OFFSET_FILL, GL_RASTERIZER_DISCARD};
    const bool desktop = !api_.isEs();
    if (desktop) {
        names.insert(names.end(),
                     {GL_COLOR_LOGIC_OP, GL_FRAMEBUFFER_SRGB, GL_DEPTH_CLAMP, GL_SAMPLE_MASK, GL_PRIMITIVE_RESTART, GL_POLYGON_SMOOTH});
        for (GLenum i = 0; i < 8; ++i)
            names.push_back(GL_CLIP_DISTANCE0 + i);
    }
    if (!desktop || api_.atLeast(4, 3))
        names.push_back(GL_PRIMITIVE_RESTART_FIXED_INDEX);
    for (const GLenum name : names) {
        switches_.emplace_back(name, api_->IsEnabled(name) == GL_TRUE);
        api_->Disable(name);
    }
}

void StateGuard::saveFixedFunction()
{
    const int buffers = indexedBlend_ ? integer(api_, GL_MAX_DRAW_BUFFERS) : 1;
    for (int i = 0; i < buffers; ++i) {
        const auto index = static_cast<GLuint>(i);
        DrawBuffer saved;
        saved.blend = (indexedBlend_ ? api_->IsEnabledi(GL_BLEND, index) : api_->IsEnabled(GL_BLEND)) == GL_TRUE;
        for (std::size_t q = 0; q < blendQueries.size(); ++q) {
            if (indexedFunctions_)
                api_->GetIntegeri_v(blendQueries[q], index, &saved.blending[q]);
            else
                api_->GetIntegerv(blendQueries[q], &saved.blending[q]);
        }
        if (indexedBlend_)
            api_->GetBooleani_v(GL_COLOR_WRITEMASK, index, saved.mask.data());
        else
            api_->GetBooleanv(GL_COLOR_WRITEMASK, saved.mask.data());
        drawBuffers_.push_back(saved);
    }
    api_->Disable(GL_BLEND);
    api_->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);

    const int viewports = indexedViewports_ ? integer(api_, GL_MAX_VIEWPORTS) : 1;
    for (int i = 0; i < viewports; ++i) {
        const auto index = static_cast<GLuint>(i);
        ViewportState saved;
        if (indexedViewports_) {
            api_->GetFloati_v(GL_VIEWPORT, index, saved.box.data());
            api_->GetIntegeri_v(GL_SCISSOR_BOX, index, saved.scissorBox.data());
        } else {
            api_->GetFloatv(GL_VIEWPORT, saved.box.data());
            api_->GetIntegerv(GL_SCISSOR_BOX, saved.scissorBox.data());
        }
        saved.scissor = (indexedViewports_ ? api_->IsEnabledi(GL_SCISSOR_TEST, index) : api_->IsEnabled(GL_SCISSOR_TEST)) == GL_TRUE;
        viewports_.push_back(saved);
    }
    api_->Disable(GL_SCISSOR_TEST);

    api_->GetFloatv(GL_COLOR_CLEAR_VALUE, clearColor_.data());
    api_->GetFloatv(GL_BLEND_COLOR, blendColor_.data());
    api_->GetBooleanv(GL_DEPTH_WRITEMASK, &depthMask_);
    api_->DepthMask(GL_FALSE);
    if (!api_.isEs()) {
        api_->GetIntegerv(GL_POLYGON_MODE, polygonMode_.data());
        api_->PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    }
}

void StateGuard::restoreFixedFunction() const
{
    for (std::size_t i = 0; i < drawBuffers_.size(); ++i) {
        const auto index = static_cast<GLuint>(i);
        const DrawBuffer& saved = drawBuffers_[i];
        std::array<GLenum, 6> f{};
        std::transform(saved.blending.begin(), saved.blending.end(), f.begin(), unsignedName);
        if (indexedFunctions_) {
            api_->BlendFuncSeparatei(index, f[0], f[1], f[2], f[3]);
            api_->BlendEquationSeparatei(index, f[4], f[5]);
        } else {
            api_->BlendFuncSeparate(f[0], f[1], f[2], f[3]);
            api_->BlendEquationSeparate(f[4], f[5]);
        }
        if (!indexedBlend_) {
            setSwitch(api_, GL_BLEND, saved.blend);
            api_->ColorMask(saved.mask[0], saved.mask[1], saved.mask[2], saved.mask[3]);
            continue;
        }
        if (saved.blend)
            api_->Enablei(GL_BLEND, index);
        else
            api_->Disablei(GL_BLEND, index);
        api_->ColorMaski(index, saved.mask[0], saved.mask[1], saved.mask[2], saved.mask[3]);
    }
    for (std::size_t i = 0; i < viewports_.size(); ++i) {
        const auto index = static_cast<GLuint>(i);
        const ViewportState& saved = viewports_[i];
        const std::array<GLint, 4>& box = saved.scissorBox;
        if (!indexedViewports_) {
            api_->Viewport(static_cast<GLint>(saved.box[0]), static_cast<GLint>(saved.box[1]), static_cast<GLsizei>(saved.box[2]),
                           static_cast<GLsizei>(saved.box[3]));
            api_->Scissor(box[0], box[1], box[2], box[3]);
            setSwitch(api_, GL_SCISSOR_TEST, saved.scissor);
            continue;
        }
        api_->ViewportIndexedfv(index, saved.box.data());
        api_->ScissorIndexed(index, box[0], box[1], box[2], box[3]);
        if (saved.scissor)
            api_->Enablei(GL_SCISSOR_TEST, index);
        else
            api_->Disablei(GL_SCISSOR_TEST, index);
    }
    api_->ClearColor(clearColor_[0], clearColor_[1], clearColor_[2], clearColor_[3]);
    api_->BlendColor(blendColor_[0], blendColor_[1], blendColor_[2], blendColor_[3]);
    api_->DepthMask(depthMask_);
    if (!api_.isEs())
        api_->PolygonMode(GL_FRONT_AND_BACK, unsignedName(polygonMode_[0])); // the core profile has one mode for both
}

void StateGuard::saveBuffers(GLenum target, GLenum query, GLenum start, GLenum size, int count, GLint& generic,
                             std::vector<IndexedBuffer>& indexed) const
{
    generic = integer(api_, query);
    indexed.resize(static_cast<std::size_t>(std::max(count, 0)));
    for (std::size_t i = 0; i < indexed.size(); ++i) {
        const auto index = static_cast<GLuint>(i);
        api_->GetIntegeri_v(query, index, &indexed[i].buffer);
        api_->GetInteger64i_v(start, index, &indexed[i].start);
        api_->GetInteger64i_v(size, index, &indexed[i].size);
    }
    api_->BindBuffer(target, 0);
}

void StateGuard::restoreBuffers(GLenum target, GLint generic, const std::vector<IndexedBuffer>& indexed) const
{
    for (std::size_t i = 0; i < indexed.size(); ++i) {
        const IndexedBuffer& saved = indexed[i];
        if (saved.buffer != 0 && saved.size != 0)
            api_->BindBufferRange(target, static_cast<GLuint>(i), unsignedName(saved.buffer), static_cast<GLintptr>(saved.start),
                                  static_cast<GLsizeiptr>(saved.size));
        else
            api_->BindBufferBase(target, static_cast<GLuint>(i), unsignedName(saved.buffer));
    }
    // Indexed bindings change the plain one: it goes last.
    api_->BindBuffer(target, unsignedName(generic));
}

void StateGuard::saveBindings(const GuardedBindings& wanted)
{
    program_ = integer(api_, GL_CURRENT_PROGRAM);
    api_->UseProgram(0);
    if (!api_.isEs() && api_.atLeast(4, 1)) {
        pipeline_ = integer(api_, GL_PROGRAM_PIPELINE_BINDING);
        api_->BindProgramPipeline(0);
    }
    vertexArray_ = integer(api_, GL_VERTEX_ARRAY_BINDING);
    api_->BindVertexArray(0);
    drawFramebuffer_ = integer(api_, GL_DRAW_FRAMEBUFFER_BINDING);
    readFramebuffer_ = integer(api_, GL_READ_FRAMEBUFFER_BINDING);

    activeTexture_ = integer(api_, GL_ACTIVE_TEXTURE);
    textureUnits_.resize(static_cast<std::size_t>(std::clamp(wanted.textureUnits, 0, api_.limits().textureUnits)));
    for (std::size_t i = 0; i < textureUnits_.size(); ++i) {
        api_->ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
        TextureUnit& saved = textureUnits_[i];
        saved = {integer(api_, GL_TEXTURE_BINDING_2D), integer(api_, GL_TEXTURE_BINDING_3D), integer(api_, GL_SAMPLER_BINDING)};
        // A sampler object would override the filters of our textures.
        api_->BindSampler(static_cast<GLuint>(i), 0);
    }
    api_->ActiveTexture(GL_TEXTURE0);

    for (std::size_t i = 0; i < plainBufferTargets.size(); ++i) {
        plainBuffers_[i] = integer(api_, plainBufferTargets[i][1]);
        api_->BindBuffer(plainBufferTargets[i][0], 0);
    }
    saveBuffers(GL_UNIFORM_BUFFER, GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE, wanted.uniformBuffers,
                uniformBuffer_, uniformBuffers_);
    if (!api_.hasCompute())
        return;
    saveBuffers(GL_SHADER_STORAGE_BUFFER, GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START, GL_SHADER_STORAGE_BUFFER_SIZE,
                wanted.storageBuffers, storageBuffer_, storageBuffers_);
    imageUnits_.resize(static_cast<std::size_t>(std::clamp(wanted.imageUnits, 0, integer(api_, GL_MAX_IMAGE_UNITS))));
    for (std::size_t i = 0; i < imageUnits_.size(); ++i) {
        ImageUnit& unit = imageUnits_[i];
        const auto index = static_cast<GLuint>(i);
        api_->GetIntegeri_v(GL_IMAGE_BINDING_NAME, index, &unit.texture);
        api_->GetIntegeri_v(GL_IMAGE_BINDING_LEVEL, index, &unit.level);
        api_->GetIntegeri_v(GL_IMAGE_BINDING_LAYERED, index, &unit.layered);
        api_->GetIntegeri_v(GL_IMAGE_BINDING_LAYER, index, &unit.layer);
        api_->GetIntegeri_v(GL_IMAGE_BINDING_ACCESS, index, &unit.access);
        api_->GetIntegeri_v(GL_IMAGE_BINDING_FORMAT, index, &unit.format);
    }
}

void StateGuard::restoreBindings() const
{
    for (std::size_t i = 0; i < imageUnits_.size(); ++i) {
        const ImageUnit& unit = imageUnits_[i];
        api_->BindImageTexture(static_cast<GLuint>(i), unsignedName(unit.texture), unit.level, unit.layered ? GL_TRUE : GL_FALSE,
                               unit.layer, unsignedName(unit.access), unsignedName(unit.format));
    }
    if (api_.hasCompute())
        restoreBuffers(GL_SHADER_STORAGE_BUFFER, storageBuffer_, storageBuffers_);
    restoreBuffers(GL_UNIFORM_BUFFER, uniformBuffer_, uniformBuffers_);
    for (std::size_t i = 0; i < plainBufferTargets.size(); ++i)
        api_->BindBuffer(plainBufferTargets[i][0], unsignedName(plainBuffers_[i]));

    // A texture of ours that the host had bound may have made room for another meanwhile: its unit stays empty.
    const auto bindAgain = [&](GLenum target, GLint texture) {
        api_->BindTexture(target, api_->IsTexture(unsignedName(texture)) ? unsignedName(texture) : 0);
    };
    for (std::size_t i = 0; i < textureUnits_.size(); ++i) {
        api_->ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
        bindAgain(GL_TEXTURE_2D, textureUnits_[i].texture2d);
        bindAgain(GL_TEXTURE_3D, textureUnits_[i].texture3d);
        api_->BindSampler(static_cast<GLuint>(i), unsignedName(textureUnits_[i].sampler));
    }
    api_->ActiveTexture(unsignedName(activeTexture_));

    api_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, unsignedName(drawFramebuffer_));
    api_->BindFramebuffer(GL_READ_FRAMEBUFFER, unsignedName(readFramebuffer_));
    api_->BindVertexArray(unsignedName(vertexArray_));
    if (!api_.isEs() && api_.atLeast(4, 1))
        api_->BindProgramPipeline(unsignedName(pipeline_));
    api_->UseProgram(unsignedName(program_));
}

} // namespace sky::gl
