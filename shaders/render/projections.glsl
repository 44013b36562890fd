// Directions of the built-in projections; twins: showmysky/src/view_direction.cpp.
// The camera's own frame: x right, y up, z forward. Its axes in the frame of the sky come as `cameraAxes`.

uniform int projection;      // 0 equirectangular, 1 perspective, 2 fisheye, 3 texture of directions
uniform mat3 cameraAxes;
uniform vec2 projectionScale; // for pictures from -1 to 1 across: (half width, half height) in rad, tangents, or rad
uniform sampler2D directions;
uniform vec2 pictureSize;    // pixels

vec3 viewDirection(vec2 position)
{
    vec2 p = (2.0 * position / pictureSize - 1.0) * projectionScale;
    if (projection == 3)
        return texelFetch(directions, ivec2(position / pictureSize * vec2(textureSize(directions, 0))), 0).xyz;
    if (projection == 1)
        return cameraAxes * vec3(p, 1.0);
    if (projection == 2) {
        float angle = length(p);
        if (angle > 2.0 * halfPi)
            return vec3(0.0);
        vec2 turned = cosineAndSine(angle);
        float scale = angle > 1e-6 ? turned.y / angle : 1.0;
        return cameraAxes * vec3(p * scale, turned.x);
    }
    if (abs(p.y) > halfPi || abs(p.x) > 2.0 * halfPi)
        return vec3(0.0);
    vec2 across = cosineAndSine(p.x), up = cosineAndSine(p.y);
    return cameraAxes * vec3(up.x * across.y, up.y, up.x * across.x);
}
