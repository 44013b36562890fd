// Angles from cosines, with our own arcsine: drivers' differ by up to 1e-4 rad, a third of what a pixel of dusk needs.

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

// Inverse hyperbolic sine; the driver's own may lose its digits for negative arguments.
float inverseSinh(float x)
{
    float a = abs(x);
    float y = log(a + sqrt(a * a + 1.0));
    return x < 0.0 ? -y : y;
}
