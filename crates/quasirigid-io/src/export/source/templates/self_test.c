/* Checks {{name}}.c against numbers of quasirigid: prints what differs, and returns how much does. */
#include "{{name}}.h"

#include <math.h>
#include <stdio.h>

#define COUNT {{test_count}}

/* Angular momentum, torque; angular velocity, rate of the angular momentum, power, energy. */
static const double tests[COUNT][14] = {{tests}};

static double length(const double a[3])
{
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

/* Largest difference of some columns, relative to the largest of their numbers. */
static double difference(double found[COUNT][14], int first, int end)
{
    double largest = 0.0, apart = 0.0;
    int row, i;

    for (row = 0; row < COUNT; row++) {
        for (i = first; i < end; i++) {
            largest = fmax(largest, fabs(tests[row][i]));
            apart = fmax(apart, fabs(tests[row][i] - found[row][i]));
        }
    }
    return largest > 0.0 ? apart / largest : apart;
}

static int judged(const char *what, double error, double allowed)
{
    printf("%-40s %.1e\n", what, error);
    return error <= allowed ? 0 : 1;
}

int main(void)
{
    static const double none[3] = {0.0, 0.0, 0.0};
    double found[COUNT][14], y[7], K[3], size, energy, dt, drift = 0.0, gain = 0.0, back = 0.0;
    int row, i, step, wrong = 0;

    for (row = 0; row < COUNT; row++) {
        {{name}}_motion motion;
        {{name}}_motion_at(tests[row], tests[row] + 3, &motion);
        for (i = 0; i < 3; i++) {
            found[row][6 + i] = motion.omega[i];
            found[row][9 + i] = motion.rate[i];
        }
        found[row][12] = motion.power;
        found[row][13] = {{name}}_energy(tests[row]);
    }
    wrong += judged("angular velocity", difference(found, 6, 9), 1e-12);
    wrong += judged("rate of the angular momentum", difference(found, 9, 12), 1e-12);
    wrong += judged("power", difference(found, 12, 13), 1e-11);
    wrong += judged("energy", difference(found, 13, 14), 1e-12);

    if ({{name}}_momentum_of(tests[1] + 6, K) == 0) {
        for (i = 0; i < 3; i++) {
            back = fmax(back, fabs(K[i] - tests[1][i]) / length(tests[1]));
        }
        wrong += judged("angular momentum of an angular velocity", back, 1e-11);
    }

    for (i = 0; i < 7; i++) {
        y[i] = i < 3 ? tests[1][i] : (i == 3 ? 1.0 : 0.0);
    }
    size = length(y);
    energy = {{name}}_energy(y);
    dt = 0.05 / length(tests[1] + 6);
    for (step = 0; step < 2000; step++) {
        double now;
        {{name}}_step(y, none, dt);
        now = {{name}}_energy(y);
        drift = fmax(drift, fabs(length(y) - size) / size);
        gain = fmax(gain, (now - energy) / energy);
        energy = now;
    }
    wrong += judged("drift of |K| in 2000 steps", drift, 1e-12);
    wrong += judged("largest gain of energy in a step", gain, 4e-15);
    return wrong;
}
