# Gives half of the light of bench/cloud-layer.txt's droplets a peak of g = 0.99, as diffraction does: bench/aureole.py.
s/return vec4((1.0-g\*g)\/(4.0\*PI\*pow(1.0+g\*g-2.0\*g\*dotViewSun, 1.5)));/CONST float p = 0.99; return vec4(0.5*(1.0-g*g)\/pow(1.0+g*g-2.0*g*dotViewSun, 1.5) + 0.5*(1.0-p*p)\/pow(1.0+p*p-2.0*p*dotViewSun, 1.5))\/(4.0*PI);/
