// Where a distance along a line of sight lies in the tables of aerial perspective; twin: showmysky/src/aerial_axis.hpp.
// Fine at the camera, and at the ground where the line ends there; even where both ends are thin air.

const float aerialScale = 300.0; // m

const int aerialFromCamera = 0, aerialBothEnds = 1, aerialEven = 2;

// 0..1 of a distance 0..length.
float aerialCoordinate(float distance, float length_, int spacing)
{
    if (spacing == aerialEven || length_ < 1e-3)
        return distance / max(length_, 1e-3);
    float range = log(1.0 + length_ / aerialScale);
    if (spacing == aerialFromCamera)
        return log(1.0 + distance / aerialScale) / range;
    return 0.5 + 0.5 * log((distance + aerialScale) / (length_ - distance + aerialScale)) / range;
}

// Its inverse.
float aerialDistance(float x, float length_, int spacing)
{
    if (spacing == aerialEven || length_ < 1e-3)
        return x * length_;
    float range = log(1.0 + length_ / aerialScale);
    if (spacing == aerialFromCamera)
        return aerialScale * (exp(x * range) - 1.0);
    float quotient = exp((2.0 * x - 1.0) * range);
    return (quotient * (length_ + aerialScale) - aerialScale) / (1.0 + quotient);
}

// Place among `count` nodes, in texels from the first: linear in the distance between two of them.
float aerialPlace(float distance, float length_, int spacing, float count)
{
    float last = count - 1.0, x = clamp(aerialCoordinate(distance, length_, spacing), 0.0, 1.0);
    float k = min(floor(x * last), last - 1.0);
    float near = aerialDistance(k / last, length_, spacing), far = aerialDistance((k + 1.0) / last, length_, spacing);
    return k + (far > near ? clamp((distance - near) / (far - near), 0.0, 1.0) : 1.0);
}
