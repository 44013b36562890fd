// Angles from cosines and back, with functions of our own: drivers' arcsines differ by up to 1e-4 rad, a third of what a pixel of dusk
// needs, and their sines may by 5e-4 (the Vulkan specification allows 2^-11).

const float halfPi = 1.57079632679;

// Elevation whose sine is mu, -1 <= mu <= 1; absolute error < 3e-7 rad. Argument reduction asin x = pi/2 - 2 asin sqrt((1-x)/2)
// above 1/2; minimax polynomial of the Cephes library (Moshier 1992, asinf) below.
float elevationOf(float mu)
{
    float a = min(abs(mu), 1.0);
    bool steep = a > 0.5;
    float z = steep ? 0.5 * (1.0 - a) : a * a;
    float x = steep ? sqrt(z) : a;
    float p = x + x * z * ((((4.2163199048e-2 * z + 2.4181311049e-2) * z + 4.5470025998e-2) * z + 7.4953002686e-2) * z
                           + 1.6666752422e-1);
    float e = steep ? halfPi - 2.0 * p : p;
    return mu < 0.0 ? -e : e;
}

// Cosine and sine, -100 <= x <= 100; absolute error < 2e-7. Reduction to the nearest quarter turn, whose length comes in three parts
// (Cody & Waite 1980); minimax polynomials of the Cephes library (Moshier 1992, sinf and cosf).
vec2 cosineAndSine(float x)
{
    float k = floor(x / halfPi + 0.5);
    float r = ((x - k * 1.5703125) - k * 4.83751296997e-4) - k * 7.549789954892e-8, z = r * r;
    float s = r + r * z * ((-1.9515295891e-4 * z + 8.3321608736e-3) * z - 1.6666654611e-1);
    float c = 1.0 - 0.5 * z + z * z * ((2.443315711809948e-5 * z - 1.388731625493765e-3) * z + 4.166664568298827e-2);
    int turn = int(k) & 3;
    vec2 v = (turn & 1) == 0 ? vec2(c, s) : vec2(-s, c);
    return turn > 1 ? -v : v;
}

float sine(float x) { return cosineAndSine(x).y; }

// Inverse hyperbolic sine; the driver's own may lose its digits for negative arguments.
float inverseSinh(float x)
{
    float a = abs(x);
    float y = log(a + sqrt(a * a + 1.0));
    return x < 0.0 ? -y : y;
}
