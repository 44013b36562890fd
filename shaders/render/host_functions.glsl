// The functions that a host adds to its own fragment shaders: Sky::shaderFunctions. They answer in X, Y, Z and scotopic luminance.
// Every other name of this text is renamed below, so that it meets none of the host's.
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler3D;
#define halfPi showmyskyHalfPi
#define elevationOf showmyskyElevationOf
#define inverseSinh showmyskyInverseSinh
#define horizonAngleScale showmyskyHorizonAngleScale
#define SkyViewAxes ShowmyskySkyViewAxes
#define focusWidth showmyskyFocusWidth
#define SkyViewPlace ShowmyskySkyViewPlace
#define angleBetween showmyskyAngleBetween
#define placeInSkyView showmyskyPlaceInSkyView
#define skyViewCoordinate showmyskySkyViewCoordinate
#define skyTables showmyskySkyTables
#define phases showmyskyPhases
#define tableScales showmyskyTableScales
#define sunDirection showmyskySunDirection
#define horizon showmyskyHorizon
#define inverseRanges showmyskyInverseRanges
#define tableSize showmyskyTableSize
#define phaseWidth showmyskyPhaseWidth
#define wholeTurn showmyskyWholeTurn
#define viewFocus showmyskyViewFocus
#define azimuthFocus showmyskyAzimuthFocus
#define mirror showmyskyMirror
#define lookIntoMirror showmyskyLookIntoMirror
#define skyLight showmyskySkyLight
#define Planet ShowmyskyPlanet
#define AirSpan ShowmyskyAirSpan
#define spanInAir showmyskySpanInAir
#define aerialScale showmyskyAerialScale
#define aerialFromCamera showmyskyAerialFromCamera
#define aerialBothEnds showmyskyAerialBothEnds
#define aerialEven showmyskyAerialEven
#define aerialCoordinate showmyskyAerialCoordinate
#define aerialDistance showmyskyAerialDistance
#define aerialPlace showmyskyAerialPlace
#define aerial showmyskyAerial
#define aerialPlanet showmyskyAerialPlanet
#define aerialAltitude showmyskyAerialAltitude
#define aerialSize showmyskyAerialSize
#define horizontalSunlight showmyskyHorizontalSunlight
#define facingSunlight showmyskyFacingSunlight
#define horizontalSkylight showmyskyHorizontalSkylight
#define aerialAt showmyskyAerialAt
#define aerialPlaceOf showmyskyAerialPlaceOf
#define AerialPlace ShowmyskyAerialPlace
#define opacityOf showmyskyOpacityOf
#define CityPlace ShowmyskyCityPlace
#define placeAmongCities showmyskyPlaceAmongCities
#define insideCity showmyskyInsideCity
#define cityAir showmyskyCityAir
#define cityDiscs showmyskyCityDiscs
#define cityCount showmyskyCityCount
#define cityScale showmyskyCityScale
#define cityTableSize showmyskyCityTableSize
#define dipTangent showmyskyDipTangent
#define cityGround showmyskyCityGround
#define cityLight showmyskyCityLight
#define cityAirLight showmyskyCityAirLight
#define sunColours showmyskySunColours
#define sunRadius showmyskySunRadius
#define moonDirection showmyskyMoonDirection
#define moonRadius showmyskyMoonRadius
#define limbExponents showmyskyLimbExponents
#define sunDisc showmyskySunDisc

#include "render/sky_light.glsl"
#include "render/city_light.glsl"
#include "render/sun_disc.glsl"
#include "lib/geometry.glsl"
#include "lib/aerial.glsl"

// [table][distance] in depth, [view], [azimuth]: shares of the light of each of the sky's tables, then optical depths.
uniform sampler3D aerial;
uniform vec2 aerialPlanet;    // radius, top of the atmosphere, m
uniform float aerialAltitude; // of the camera, m
uniform vec3 aerialSize;      // azimuths (in an eclipse all around), views of one half, distances
uniform vec4 horizontalSunlight;  // of a horizontal surface, lx
uniform vec4 facingSunlight;       // of a surface that faces the Sun, lx
uniform vec4 horizontalSkylight;  // of a horizontal surface, lx

struct AerialPlace {
    vec2 row;      // texture coordinate of azimuth and view
    float texel;   // in depth, from a table's first
};

AerialPlace aerialPlaceOf(vec3 direction, float elevation, float distance)
{
    SkyViewAxes axes = SkyViewAxes(sunDirection, horizon, inverseRanges, aerialSize.xy, WHOLE_TURN, vec4(0.0), vec3(0.0));
    SkyViewPlace place = placeInSkyView(axes, direction, elevation);
    bool ground = elevation < horizon;
    AirSpan span = spanInAir(Planet(aerialPlanet.x, aerialPlanet.y), aerialAltitude, direction.z, ground);
    int spacing = ground ? aerialBothEnds : aerialAltitude > aerialPlanet.y ? aerialEven : aerialFromCamera;
    AerialPlace result;
    result.row = skyViewCoordinate(axes, place, 0.0, 1.0);
    float length_ = span.end - span.start, within = distance - span.start;
    result.texel = within <= 0.0 ? 0.0 : within >= length_ ? aerialSize.z - 1.0 : aerialPlace(within, length_, spacing, aerialSize.z);
    return result;
}

vec4 aerialAt(AerialPlace place, int table)
{
    float depth = (float(table) * aerialSize.z + place.texel + 0.5) / (float(SCATTERERS + 2) * aerialSize.z);
    return texture(aerial, vec3(place.row, depth));
}

// Share of light that the air takes up to a place.
vec4 opacityOf(AerialPlace place)
{
    return 1.0 - exp(-aerialAt(place, SCATTERERS + 1));
}

// Luminance of the sky or the ground in a direction (of any length), cities included, the solar disc apart; cd m^-2.
vec4 showmyskyRadiance(vec3 direction)
{
    vec3 unit = normalize(direction);
    float elevation = elevationOf(unit.z);
    lookIntoMirror(unit, elevation);
    return skyLight(unit, elevation) + cityLight(unit, elevation);
}

// Luminance of the solar disc, through the air and beside the Moon, 0 where it isn't; `pixelAngle`: over how many rad its edge is smoothed.
// A scene's switch for the disc plays no part.
vec4 showmyskySolarDisc(vec3 direction, float pixelAngle)
{
    vec3 unit = normalize(direction);
    float elevation = elevationOf(unit.z);
    lookIntoMirror(unit, elevation);
    return elevation >= horizon ? sunDisc(unit, elevation, pixelAngle) : vec4(0.0);
}

// Luminance of the air between the camera and a point at a distance (m) in a direction; cd m^-2.
vec4 showmyskyRadianceTo(vec3 direction, float distance)
{
    vec3 unit = normalize(direction);
    float elevation = elevationOf(unit.z);
    AerialPlace place = aerialPlaceOf(unit, elevation, distance);
    vec4 shares[SCATTERERS + 1];
    for (int i = 0; i <= SCATTERERS; ++i)
        shares[i] = aerialAt(place, i);
    vec4 light = skyLight(unit, elevation, shares);
    if (cityCount > 0) { // of cities' light there is no table over the distance: it is taken as spread over the air that is seen
        AerialPlace end = place;
        end.texel = aerialSize.z - 1.0;
        vec4 share = min(opacityOf(place) / max(opacityOf(end), vec4(1e-6)), vec4(1.0));
        light += share * cityAirLight(placeAmongCities(unit, elevation, horizon, dipTangent), elevation);
    }
    return light;
}

// What the same air lets through of light with the Sun's spectrum, 0..1; the ground itself is no part of it.
vec4 showmyskyTransmittance(vec3 direction, float distance)
{
    vec3 unit = normalize(direction);
    return exp(-aerialAt(aerialPlaceOf(unit, elevationOf(unit.z), distance), SCATTERERS + 1));
}

// Illuminance at the camera, lx: by the Sun, of a horizontal surface or of one with a unit normal; by the sky above the horizon, of a
// horizontal surface.
vec4 showmyskySunIlluminance()
{
    return horizontalSunlight;
}
vec4 showmyskySunIlluminance(vec3 normal)
{
    return max(dot(normal, sunDirection), 0.0) * facingSunlight;
}
vec4 showmyskySkyIlluminance()
{
    return horizontalSkylight;
}

#undef halfPi
#undef elevationOf
#undef inverseSinh
#undef horizonAngleScale
#undef SkyViewAxes
#undef focusWidth
#undef SkyViewPlace
#undef angleBetween
#undef placeInSkyView
#undef skyViewCoordinate
#undef skyTables
#undef phases
#undef tableScales
#undef sunDirection
#undef horizon
#undef inverseRanges
#undef tableSize
#undef phaseWidth
#undef wholeTurn
#undef viewFocus
#undef azimuthFocus
#undef mirror
#undef lookIntoMirror
#undef skyLight
#undef Planet
#undef AirSpan
#undef spanInAir
#undef aerialScale
#undef aerialFromCamera
#undef aerialBothEnds
#undef aerialEven
#undef aerialCoordinate
#undef aerialDistance
#undef aerialPlace
#undef aerial
#undef aerialPlanet
#undef aerialAltitude
#undef aerialSize
#undef horizontalSunlight
#undef facingSunlight
#undef horizontalSkylight
#undef aerialAt
#undef aerialPlaceOf
#undef AerialPlace
#undef opacityOf
#undef CityPlace
#undef placeAmongCities
#undef insideCity
#undef cityAir
#undef cityDiscs
#undef cityCount
#undef cityScale
#undef cityTableSize
#undef dipTangent
#undef cityGround
#undef cityLight
#undef cityAirLight
#undef sunColours
#undef sunRadius
#undef moonDirection
#undef moonRadius
#undef limbExponents
#undef sunDisc
#undef SCATTERERS
#undef PHASE_ROWS
#undef SUN_COLOURS
#undef CITY_COLOURS
#undef WHOLE_TURN
