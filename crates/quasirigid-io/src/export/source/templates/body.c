{{heading}}
#include "{{name}}.h"

#include <math.h>

const double {{name}}_start[7] = {{start}};
const double {{name}}_inertia[6] = {{inertia}};
const double {{name}}_mass = {{mass}};

/* Spins (rad/s) up to which the equations hold, and from which they fail. */
static const double spin_holds = {{spin_holds}};
static const double spin_fails = {{spin_fails}};
/* Least principal moment of inertia (kg m^2). */
static const double least_moment = {{least_moment}};

static const double none[3] = {0.0, 0.0, 0.0};

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Symmetric matrices: xx, yy, zz, yz, zx, xy. */
static void times(const double S[6], const double a[3], double out[3])
{
    out[0] = S[0] * a[0] + S[5] * a[1] + S[4] * a[2];
    out[1] = S[5] * a[0] + S[1] * a[1] + S[3] * a[2];
    out[2] = S[4] * a[0] + S[3] * a[1] + S[2] * a[2];
}

static void adjugate(const double S[6], double out[6])
{
    out[0] = S[1] * S[2] - S[3] * S[3];
    out[1] = S[2] * S[0] - S[4] * S[4];
    out[2] = S[0] * S[1] - S[5] * S[5];
    out[3] = S[4] * S[5] - S[0] * S[3];
    out[4] = S[5] * S[3] - S[1] * S[4];
    out[5] = S[3] * S[4] - S[2] * S[5];
}

static void energy_gradient(const double K[3], double g[3])
{
    g[0] = {{gradient_x}};
    g[1] = {{gradient_y}};
    g[2] = {{gradient_z}};
}

static void internal_momenta(const double K[3], double c[3])
{
    (void)K;
    c[0] = {{c_x}};
    c[1] = {{c_y}};
    c[2] = {{c_z}};
}

static void dissipation(const double K[3], double T[6])
{
    (void)K;
    T[0] = {{T_xx}};
    T[1] = {{T_yy}};
    T[2] = {{T_zz}};
    T[3] = {{T_yz}};
    T[4] = {{T_zx}};
    T[5] = {{T_xy}};
}

double {{name}}_energy(const double K[3])
{
    return {{energy}};
}

void {{name}}_motion_at(const double K[3], const double torque[3], {{name}}_motion *motion)
{
    double g[3], c[3], T[6], A[6], v[3], m[3], Tv[3], once[3], twice[3], turned[3], AK[3], c_rate[3], T_rate[3];
    double a, d, along;
    int i;

    energy_gradient(K, g);
    internal_momenta(K, c);
    dissipation(K, T);
    cross(K, g, v);
    a = 1.0 + dot(K, c);
    adjugate(T, A);
    times(A, K, AK);
    d = a * a + dot(K, AK);

    /* rate of the free body */
    times(T, v, Tv);
    cross(K, Tv, turned);
    /* what the torque adds: (a - K x T)^-1 (M + c K.M) */
    along = dot(K, torque);
    for (i = 0; i < 3; i++) {
        m[i] = torque[i] + along * c[i];
    }
    times(T, m, Tv);
    cross(K, Tv, once);
    times(T, once, Tv);
    cross(K, Tv, twice);
    for (i = 0; i < 3; i++) {
        motion->rate[i] = (a * v[i] + turned[i]) / d + (m[i] + (a * once[i] + twice[i]) / d) / a;
    }

    times(T, motion->rate, T_rate);
    cross(c, motion->rate, c_rate);
    for (i = 0; i < 3; i++) {
        motion->omega[i] = g[i] + c_rate[i] + T_rate[i];
    }
    motion->power = dot(motion->rate, T_rate);
}

int {{name}}_momentum_of(const double omega[3], double K[3])
{
    static const double wheels[3] = {{wheels}};
    {{name}}_motion motion;
    double gap[3], change[3], size = sqrt(dot(omega, omega)), error = 0.0;
    int i, step;

    times({{name}}_inertia, omega, K);
    for (i = 0; i < 3; i++) {
        K[i] += wheels[i];
    }
    for (step = 0; step < 200; step++) {
        {{name}}_motion_at(K, none, &motion);
        for (i = 0; i < 3; i++) {
            gap[i] = omega[i] - motion.omega[i];
        }
        error = sqrt(dot(gap, gap));
        if (error <= 4e-16 * size) {
            return 0;
        }
        times({{name}}_inertia, gap, change);
        for (i = 0; i < 3; i++) {
            K[i] += change[i];
        }
    }
    return error <= 1e-12 * size ? 0 : 1;
}

/* Rates of the state and, last, of the energy. */
static void account(const double y[7], const double torque[3], double dy[8])
{
    {{name}}_motion motion;
    const double *w = motion.omega;
    int i;

    {{name}}_motion_at(y, torque, &motion);
    for (i = 0; i < 3; i++) {
        dy[i] = motion.rate[i];
    }
    dy[3] = -0.5 * (y[4] * w[0] + y[5] * w[1] + y[6] * w[2]);
    dy[4] = 0.5 * (y[3] * w[0] + y[5] * w[2] - y[6] * w[1]);
    dy[5] = 0.5 * (y[3] * w[1] + y[6] * w[0] - y[4] * w[2]);
    dy[6] = 0.5 * (y[3] * w[2] + y[4] * w[1] - y[5] * w[0]);
    dy[7] = dot(w, torque) - motion.power;
}

void {{name}}_rates(const double y[7], const double torque[3], double dy[7])
{
    double all[8];
    int i;

    account(y, torque, all);
    for (i = 0; i < 7; i++) {
        dy[i] = all[i];
    }
}

int {{name}}_status(const double y[7], const double torque[3])
{
    {{name}}_motion motion;
    double spin, turn;
    int i;

    {{name}}_motion_at(y, none, &motion);
    spin = sqrt(dot(motion.omega, motion.omega));
    /* the angular acceleration of a torque counts as the square of a spin */
    turn = sqrt(sqrt(dot(torque, torque)) / least_moment);
    spin = turn > spin ? turn : spin;
    for (i = 0; i < 7; i++) {
        if (!isfinite(y[i]) || !isfinite(spin)) {
            return {{NAME}}_NOT_FINITE;
        }
    }
    return spin < spin_holds ? {{NAME}}_HOLDS : spin < spin_fails ? {{NAME}}_MARGINAL : {{NAME}}_FAILS;
}

/* Inertial components of a vector in body axes, at a unit quaternion. */
static void to_inertial(const double q[4], const double v[3], double out[3])
{
    double first[3], second[3];
    int i;

    cross(q + 1, v, first);
    for (i = 0; i < 3; i++) {
        first[i] += q[0] * v[i];
    }
    cross(q + 1, first, second);
    for (i = 0; i < 3; i++) {
        out[i] = v[i] + 2.0 * second[i];
    }
}

static void normalise(double q[4])
{
    double size = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    int i;

    for (i = 0; i < 4; i++) {
        q[i] /= size;
    }
}

/* Puts K back where |K| and the energy have their values. */
static void restore_momentum(double K[3], double size, double energy)
{
    double g[3], across[3], squared, gap, along, factor;
    int i, pass;

    for (pass = 0; pass < 3; pass++) {
        factor = size / sqrt(dot(K, K));
        for (i = 0; i < 3; i++) {
            K[i] *= factor;
        }
        energy_gradient(K, g);
        along = dot(g, K) / dot(K, K);
        for (i = 0; i < 3; i++) {
            across[i] = g[i] - along * K[i];
        }
        squared = dot(across, across);
        gap = energy - {{name}}_energy(K);
        /* next to a steady spin the energy does not see where K is */
        if (pass == 2 || !(fabs(gap) * sqrt(dot(g, g)) < squared * size)) {
            return;
        }
        for (i = 0; i < 3; i++) {
            K[i] += gap / squared * across[i];
        }
    }
}

/* The smallest rotation that gives K its former inertial direction. */
static void realign(const double before[7], double after[7])
{
    double then[3], now[3], turned[3], p[4], q[4];
    int i;

    to_inertial(before + 3, before, then);
    to_inertial(after + 3, after, now);
    p[0] = sqrt(dot(now, now) * dot(then, then)) + dot(now, then);
    cross(now, then, p + 1);
    if (!(p[0] > 0.0)) {
        return;
    }
    for (i = 0; i < 4; i++) {
        q[i] = after[3 + i];
    }
    cross(p + 1, q + 1, turned);
    after[3] = p[0] * q[0] - dot(p + 1, q + 1);
    for (i = 0; i < 3; i++) {
        after[4 + i] = p[0] * q[1 + i] + q[0] * p[1 + i] + turned[i];
    }
    normalise(after + 3);
}

int {{name}}_step(double y[7], const double torque[3], double dt)
{
    static const double place[4] = {0.0, 0.5, 0.5, 1.0};
    static const double weight[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
    double slope[8] = {0.0}, sum[8] = {0.0}, stage[7], next[7], size;
    int i, s;

    normalise(y + 3);
    for (s = 0; s < 4; s++) {
        for (i = 0; i < 7; i++) {
            stage[i] = y[i] + place[s] * dt * slope[i];
        }
        account(stage, torque, slope);
        for (i = 0; i < 8; i++) {
            sum[i] += weight[s] * slope[i];
        }
    }
    for (i = 0; i < 7; i++) {
        next[i] = y[i] + dt * sum[i];
    }
    normalise(next + 3);
    size = sqrt(dot(y, y));
    if (dot(torque, torque) == 0.0 && size > 0.0) {
        restore_momentum(next, size, {{name}}_energy(y) + dt * sum[7]);
        realign(y, next);
    }
    for (i = 0; i < 7; i++) {
        y[i] = next[i];
    }
    return {{name}}_status(y, torque);
}
