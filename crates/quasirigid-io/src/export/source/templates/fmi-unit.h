/* What both standards share: the states, inputs and outputs of the free body in {{name}}.c, and steps of a fixed length. */
#include "{{name}}.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#if defined(_WIN32)
#define EXPORT __declspec(dllexport)
#elif defined(__GNUC__)
#define EXPORT __attribute__((visibility("default")))
#else
#define EXPORT
#endif

/* States: angular momentum, quaternion, position and velocity of the centre of mass, inertial axes. */
#define STATES 13
/* Inputs: torque and force, body axes. */
#define INPUTS 6
/* Value references: states, their rates, inputs, then the outputs from here on. */
#define OMEGA (2 * STATES + INPUTS)
#define MOMENTUM (OMEGA + 3)
#define ENERGY (OMEGA + 4)
#define POWER (OMEGA + 5)
#define NUTATION (OMEGA + 6)
#define VALID (OMEGA + 7)
#define TIME (OMEGA + 8)

typedef struct {
    double time;
    double x[STATES];
    double u[INPUTS];
} body;

static const double start_place[6] = {{place}};
/* Axis that the angular momentum circles at the start. */
static const double axis[3] = {{axis}};
/* Longest step relative to the time in which the body turns by a radian. */
static const double longest = 0.02;

static void reset(body *b)
{
    b->time = 0.0;
    memcpy(b->x, {{name}}_start, 7 * sizeof(double));
    memcpy(b->x + 7, start_place, 6 * sizeof(double));
    memset(b->u, 0, sizeof b->u);
}

/* Acceleration of the centre of mass, inertial axes. */
static void acceleration(const body *b, double a[3])
{
    const double *q = b->x + 3, *F = b->u + 3;
    double v[3], size = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    int i;

    v[0] = q[2] * F[2] - q[3] * F[1] + q[0] * F[0];
    v[1] = q[3] * F[0] - q[1] * F[2] + q[0] * F[1];
    v[2] = q[1] * F[1] - q[2] * F[0] + q[0] * F[2];
    a[0] = F[0] + 2.0 / size * (q[2] * v[2] - q[3] * v[1]);
    a[1] = F[1] + 2.0 / size * (q[3] * v[0] - q[1] * v[2]);
    a[2] = F[2] + 2.0 / size * (q[1] * v[1] - q[2] * v[0]);
    for (i = 0; i < 3; i++) {
        a[i] /= {{name}}_mass;
    }
}

static void rates(const body *b, double dx[STATES])
{
    {{name}}_rates(b->x, b->u, dx);
    memcpy(dx + 7, b->x + 10, 3 * sizeof(double));
    acceleration(b, dx + 10);
}

static double length(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static double nutation(const double K[3])
{
    double across[3], along = K[0] * axis[0] + K[1] * axis[1] + K[2] * axis[2];

    across[0] = K[1] * axis[2] - K[2] * axis[1];
    across[1] = K[2] * axis[0] - K[0] * axis[2];
    across[2] = K[0] * axis[1] - K[1] * axis[0];
    return atan2(length(across), along);
}

static int real_of(const body *b, unsigned int reference, double *value)
{
    double dx[STATES];
    {{name}}_motion motion;

    if (reference < STATES) {
        *value = b->x[reference];
    } else if (reference < 2 * STATES) {
        rates(b, dx);
        *value = dx[reference - STATES];
    } else if (reference < OMEGA) {
        *value = b->u[reference - 2 * STATES];
    } else if (reference < MOMENTUM || reference == POWER) {
        {{name}}_motion_at(b->x, b->u, &motion);
        *value = reference == POWER ? motion.power : motion.omega[reference - OMEGA];
    } else if (reference == MOMENTUM) {
        *value = length(b->x);
    } else if (reference == ENERGY) {
        *value = {{name}}_energy(b->x);
    } else if (reference == NUTATION) {
        *value = nutation(b->x);
    } else if (reference == TIME) {
        *value = b->time;
    } else {
        return 1;
    }
    return 0;
}

/* Rotation in two halves, translation by Simpson's rule. */
static void advance(body *b, double h)
{
    double first[3], middle[3], last[3];
    int i;

    acceleration(b, first);
    {{name}}_step(b->x, b->u, 0.5 * h);
    acceleration(b, middle);
    {{name}}_step(b->x, b->u, 0.5 * h);
    acceleration(b, last);
    for (i = 0; i < 3; i++) {
        b->x[7 + i] += h * b->x[10 + i] + h * h / 6.0 * (first[i] + 2.0 * middle[i]);
        b->x[10 + i] += h / 6.0 * (first[i] + 4.0 * middle[i] + last[i]);
    }
    b->time += h;
}

/* New instance at the start; none for another model. */
static body *instance(const char *token)
{
    body *b = token != NULL && strcmp(token, "{{token}}") == 0 ? malloc(sizeof *b) : NULL;

    if (b != NULL) {
        reset(b);
    }
    return b;
}

static int get_reals(const body *b, const unsigned int reference[], size_t n, double value[])
{
    size_t i;
    int wrong = 0;

    for (i = 0; i < n; i++) {
        wrong |= real_of(b, reference[i], value + i);
    }
    return wrong;
}

static int set_reals(body *b, const unsigned int reference[], size_t n, const double value[])
{
    size_t i;

    for (i = 0; i < n; i++) {
        if (reference[i] < STATES) {
            b->x[reference[i]] = value[i];
        } else if (reference[i] >= 2 * STATES && reference[i] < OMEGA) {
            b->u[reference[i] - 2 * STATES] = value[i];
        } else {
            return 1;
        }
    }
    return 0;
}

static int is_valid(const body *b)
{
    return {{name}}_status(b->x, b->u) < {{NAME}}_FAILS;
}

static void nominals_of(double nominal[STATES])
{
    double size = length({{name}}_start);
    int i;

    for (i = 0; i < STATES; i++) {
        nominal[i] = i < 3 && size > 0.0 ? size : 1.0;
    }
}

static int save(const body *b, void **state)
{
    if (*state == NULL) {
        *state = malloc(sizeof *b);
    }
    if (*state == NULL) {
        return 1;
    }
    memcpy(*state, b, sizeof *b);
    return 0;
}

/* Steps short beside the rotation, to the end of a communication step. */
static int follow(body *b, double now, double step)
{
    {{name}}_motion motion;
    double least = fmin(fmin({{name}}_inertia[0], {{name}}_inertia[1]), {{name}}_inertia[2]), count;
    long i, steps;

    {{name}}_motion_at(b->x, b->u, &motion);
    count = ceil(fabs(step) * (length(motion.omega) + fabs(step) * length(motion.rate) / least) / longest);
    if (!(count < 1e9)) {
        return 1;
    }
    steps = count > 1.0 ? (long)count : 1;
    for (i = 0; i < steps; i++) {
        advance(b, step / (double)steps);
    }
    b->time = now + step;
    return {{name}}_status(b->x, b->u) == {{NAME}}_NOT_FINITE;
}
