{{heading}}
#ifndef {{NAME}}_H
#define {{NAME}}_H

#ifdef __cplusplus
extern "C" {
#endif

/* Status of the range of validity. */
#define {{NAME}}_HOLDS 0
#define {{NAME}}_MARGINAL 1
#define {{NAME}}_FAILS 2
#define {{NAME}}_NOT_FINITE 3

/* Start of the model: angular momentum (N m s, body axes), quaternion. */
extern const double {{name}}_start[7];
/* Inertia about the centre of mass (kg m^2, body axes): xx, yy, zz, yz, zx, xy. */
extern const double {{name}}_inertia[6];
/* Mass (kg). */
extern const double {{name}}_mass;

/* Motion at an angular momentum under a torque (N m, body axes). */
typedef struct {
    double omega[3]; /* angular velocity of the carrier (rad/s), body axes */
    double rate[3];  /* rate of the angular momentum in body axes (N m) */
    double power;    /* power dissipated (W) */
} {{name}}_motion;

void {{name}}_motion_at(const double K[3], const double torque[3], {{name}}_motion *motion);

/* Energy (J). */
double {{name}}_energy(const double K[3]);

/* Angular momentum with an angular velocity (rad/s) where no torque acts; returns 0 if there is one. */
int {{name}}_momentum_of(const double omega[3], double K[3]);

/* Right-hand side: rates of the state y = (K, quaternion) for any integrator. */
void {{name}}_rates(const double y[7], const double torque[3], double dy[7]);

/* Status of a state. */
int {{name}}_status(const double y[7], const double torque[3]);

/*
 * One step of the classical Runge-Kutta method with a constant torque; returns the status of the new state.
 * Without a torque |K|, the angular momentum in inertial axes and the balance of the energy are then restored to rounding.
 */
int {{name}}_step(double y[7], const double torque[3], double dt);

#ifdef __cplusplus
}
#endif

#endif
