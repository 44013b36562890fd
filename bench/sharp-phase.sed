# Turns the sample Earth's aerosols into 1.4 times as many with a peak far sharper than the harmonics, just enough for it to be truncated: bench/run.
s/1.03333e8/1.44666e8/
s/CONST float g = 0.76/CONST float g = 0.97/
s/CONST float k = .*/CONST float k = (1.0-g*g)\/(4.0*PI);/
s/return vec4(0.904.*/return vec4(k\/pow(1.0+g*g-2.0*g*c, 1.5));/
