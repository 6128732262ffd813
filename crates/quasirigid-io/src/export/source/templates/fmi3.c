/* FMI 3.0, model exchange and co-simulation: types, names and numbers are those of the standard. */
#include "fmi-unit.h"

#include <stdbool.h>
#include <stdint.h>

typedef void *fmi3Instance;
typedef void *fmi3InstanceEnvironment;
typedef void *fmi3FMUState;
typedef uint32_t fmi3ValueReference;
typedef double fmi3Float64;
typedef bool fmi3Boolean;
typedef bool fmi3Clock;
typedef const char *fmi3String;
typedef uint8_t fmi3Byte;
typedef const fmi3Byte *fmi3Binary;
typedef enum { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal } fmi3Status;
typedef enum { fmi3Independent, fmi3Constant, fmi3Fixed, fmi3Tunable, fmi3Discrete, fmi3Dependent } fmi3DependencyKind;
typedef enum { fmi3IntervalNotYetKnown, fmi3IntervalUnchanged, fmi3IntervalChanged } fmi3IntervalQualifier;
typedef void (*fmi3Callback)(void);

EXPORT const char *fmi3GetVersion(void)
{
    return "3.0";
}

EXPORT fmi3Status fmi3SetDebugLogging(fmi3Instance c, fmi3Boolean on, size_t n, const fmi3String categories[])
{
    (void)c, (void)on, (void)n, (void)categories;
    return fmi3OK;
}

EXPORT fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                                 fmi3Boolean logging, fmi3InstanceEnvironment environment,
                                                 fmi3Callback log)
{
    (void)name, (void)resources, (void)visible, (void)logging, (void)environment, (void)log;
    return instance(token);
}

EXPORT fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                                fmi3Boolean logging, fmi3Boolean events, fmi3Boolean early,
                                                const fmi3ValueReference intermediate[], size_t n,
                                                fmi3InstanceEnvironment environment, fmi3Callback log,
                                                fmi3Callback update)
{
    (void)name, (void)resources, (void)visible, (void)logging, (void)events, (void)early;
    (void)intermediate, (void)n, (void)environment, (void)log, (void)update;
    return instance(token);
}

EXPORT fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token, fmi3String resources,
                                                      fmi3Boolean visible, fmi3Boolean logging,
                                                      fmi3InstanceEnvironment environment, fmi3Callback log,
                                                      fmi3Callback update, fmi3Callback lock, fmi3Callback unlock)
{
    (void)name, (void)token, (void)resources, (void)visible, (void)logging, (void)environment;
    (void)log, (void)update, (void)lock, (void)unlock;
    return NULL;
}

EXPORT void fmi3FreeInstance(fmi3Instance c)
{
    free(c);
}

EXPORT fmi3Status fmi3EnterInitializationMode(fmi3Instance c, fmi3Boolean tolerance_given, fmi3Float64 tolerance,
                                              fmi3Float64 start, fmi3Boolean stop_given, fmi3Float64 stop)
{
    (void)tolerance_given, (void)tolerance, (void)stop_given, (void)stop;
    ((body *)c)->time = start;
    return fmi3OK;
}

/* Changes of mode that need nothing. */
#define NOTHING(name)                       \
    EXPORT fmi3Status name(fmi3Instance c) \
    {                                       \
        (void)c;                            \
        return fmi3OK;                      \
    }

NOTHING(fmi3ExitInitializationMode)
NOTHING(fmi3EnterEventMode)
NOTHING(fmi3EnterContinuousTimeMode)
NOTHING(fmi3EnterStepMode)
NOTHING(fmi3EnterConfigurationMode)
NOTHING(fmi3ExitConfigurationMode)
NOTHING(fmi3EvaluateDiscreteStates)
NOTHING(fmi3Terminate)

EXPORT fmi3Status fmi3Reset(fmi3Instance c)
{
    reset(c);
    return fmi3OK;
}

EXPORT fmi3Status fmi3GetFloat64(fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3Float64 value[], size_t count)
{
    return n != count || get_reals(c, vr, n, value) ? fmi3Error : fmi3OK;
}

EXPORT fmi3Status fmi3SetFloat64(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3Float64 value[],
                                 size_t count)
{
    return n != count || set_reals(c, vr, n, value) ? fmi3Error : fmi3OK;
}

EXPORT fmi3Status fmi3GetBoolean(fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3Boolean value[], size_t count)
{
    size_t i;

    for (i = 0; i < n; i++) {
        if (vr[i] != VALID || n != count) {
            return fmi3Error;
        }
        value[i] = is_valid(c) != 0;
    }
    return fmi3OK;
}

/* Types of variables that this body has none of, or none that are set. */
#define NONE_OF(name, type)                                                                                 \
    EXPORT fmi3Status name(fmi3Instance c, const fmi3ValueReference vr[], size_t n, type value, size_t count) \
    {                                                                                                       \
        (void)c, (void)vr, (void)value, (void)count;                                                        \
        return n == 0 ? fmi3OK : fmi3Error;                                                                 \
    }

NONE_OF(fmi3GetFloat32, float *)
NONE_OF(fmi3SetFloat32, const float *)
NONE_OF(fmi3GetInt8, int8_t *)
NONE_OF(fmi3SetInt8, const int8_t *)
NONE_OF(fmi3GetUInt8, uint8_t *)
NONE_OF(fmi3SetUInt8, const uint8_t *)
NONE_OF(fmi3GetInt16, int16_t *)
NONE_OF(fmi3SetInt16, const int16_t *)
NONE_OF(fmi3GetUInt16, uint16_t *)
NONE_OF(fmi3SetUInt16, const uint16_t *)
NONE_OF(fmi3GetInt32, int32_t *)
NONE_OF(fmi3SetInt32, const int32_t *)
NONE_OF(fmi3GetUInt32, uint32_t *)
NONE_OF(fmi3SetUInt32, const uint32_t *)
NONE_OF(fmi3GetInt64, int64_t *)
NONE_OF(fmi3SetInt64, const int64_t *)
NONE_OF(fmi3GetUInt64, uint64_t *)
NONE_OF(fmi3SetUInt64, const uint64_t *)
NONE_OF(fmi3SetBoolean, const fmi3Boolean *)
NONE_OF(fmi3GetString, fmi3String *)
NONE_OF(fmi3SetString, const fmi3String *)

EXPORT fmi3Status fmi3GetBinary(fmi3Instance c, const fmi3ValueReference vr[], size_t n, size_t size[], fmi3Binary value[],
                                size_t count)
{
    (void)c, (void)vr, (void)size, (void)value, (void)count;
    return n == 0 ? fmi3OK : fmi3Error;
}

EXPORT fmi3Status fmi3SetBinary(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const size_t size[],
                                const fmi3Binary value[], size_t count)
{
    (void)c, (void)vr, (void)size, (void)value, (void)count;
    return n == 0 ? fmi3OK : fmi3Error;
}

/* This body has no clocks. */
#define NO_CLOCK(name, type)                                                                \
    EXPORT fmi3Status name(fmi3Instance c, const fmi3ValueReference vr[], size_t n, type value) \
    {                                                                                       \
        (void)c, (void)vr, (void)value;                                                     \
        return n == 0 ? fmi3OK : fmi3Error;                                                 \
    }
#define NO_FRACTION(name, type)                                                                              \
    EXPORT fmi3Status name(fmi3Instance c, const fmi3ValueReference vr[], size_t n, type counter, type resolution) \
    {                                                                                                        \
        (void)c, (void)vr, (void)counter, (void)resolution;                                                  \
        return n == 0 ? fmi3OK : fmi3Error;                                                                  \
    }

NO_CLOCK(fmi3GetClock, fmi3Clock *)
NO_CLOCK(fmi3SetClock, const fmi3Clock *)
NO_CLOCK(fmi3GetShiftDecimal, fmi3Float64 *)
NO_CLOCK(fmi3SetShiftDecimal, const fmi3Float64 *)
NO_CLOCK(fmi3SetIntervalDecimal, const fmi3Float64 *)
NO_FRACTION(fmi3GetShiftFraction, uint64_t *)
NO_FRACTION(fmi3SetShiftFraction, const uint64_t *)
NO_FRACTION(fmi3SetIntervalFraction, const uint64_t *)

EXPORT fmi3Status fmi3GetIntervalDecimal(fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3Float64 interval[],
                                         fmi3IntervalQualifier qualifier[])
{
    (void)c, (void)vr, (void)interval, (void)qualifier;
    return n == 0 ? fmi3OK : fmi3Error;
}

EXPORT fmi3Status fmi3GetIntervalFraction(fmi3Instance c, const fmi3ValueReference vr[], size_t n, uint64_t counter[],
                                          uint64_t resolution[], fmi3IntervalQualifier qualifier[])
{
    (void)c, (void)vr, (void)counter, (void)resolution, (void)qualifier;
    return n == 0 ? fmi3OK : fmi3Error;
}

EXPORT fmi3Status fmi3ActivateModelPartition(fmi3Instance c, fmi3ValueReference clock, fmi3Float64 time)
{
    (void)c, (void)clock, (void)time;
    return fmi3Error;
}

EXPORT fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance c, fmi3ValueReference vr, size_t *n)
{
    (void)c, (void)vr, (void)n;
    return fmi3Error;
}

EXPORT fmi3Status fmi3GetVariableDependencies(fmi3Instance c, fmi3ValueReference dependent, size_t of[],
                                              fmi3ValueReference independent[], size_t on[], fmi3DependencyKind kind[],
                                              size_t n)
{
    (void)c, (void)dependent, (void)of, (void)independent, (void)on, (void)kind, (void)n;
    return fmi3Error;
}

/* Derivatives that the description does not promise. */
#define NO_DERIVATIVE(name)                                                                                   \
    EXPORT fmi3Status name(fmi3Instance c, const fmi3ValueReference unknown[], size_t unknowns,               \
                           const fmi3ValueReference known[], size_t knowns, const fmi3Float64 seed[], size_t seeds, \
                           fmi3Float64 sensitivity[], size_t sensitivities)                                   \
    {                                                                                                         \
        (void)c, (void)unknown, (void)unknowns, (void)known, (void)knowns;                                    \
        (void)seed, (void)seeds, (void)sensitivity, (void)sensitivities;                                      \
        return fmi3Error;                                                                                     \
    }

NO_DERIVATIVE(fmi3GetDirectionalDerivative)
NO_DERIVATIVE(fmi3GetAdjointDerivative)

EXPORT fmi3Status fmi3GetOutputDerivatives(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const int32_t order[],
                                           fmi3Float64 value[], size_t count)
{
    (void)c, (void)vr, (void)order, (void)value, (void)count;
    return n == 0 ? fmi3OK : fmi3Error;
}

EXPORT fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState *state)
{
    return save(c, state) ? fmi3Error : fmi3OK;
}

EXPORT fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState state)
{
    memcpy(c, state, sizeof(body));
    return fmi3OK;
}

EXPORT fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState *state)
{
    (void)c;
    free(*state);
    *state = NULL;
    return fmi3OK;
}

EXPORT fmi3Status fmi3SerializedFMUStateSize(fmi3Instance c, fmi3FMUState state, size_t *size)
{
    (void)c, (void)state;
    *size = sizeof(body);
    return fmi3OK;
}

EXPORT fmi3Status fmi3SerializeFMUState(fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], size_t size)
{
    (void)c;
    if (size != sizeof(body)) {
        return fmi3Error;
    }
    memcpy(bytes, state, size);
    return fmi3OK;
}

EXPORT fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const fmi3Byte bytes[], size_t size, fmi3FMUState *state)
{
    if (size != sizeof(body) || save(c, state)) {
        return fmi3Error;
    }
    memcpy(*state, bytes, size);
    return fmi3OK;
}

EXPORT fmi3Status fmi3UpdateDiscreteStates(fmi3Instance c, fmi3Boolean *again, fmi3Boolean *terminate, fmi3Boolean *nominals,
                                           fmi3Boolean *values, fmi3Boolean *next_given, fmi3Float64 *next)
{
    (void)c;
    *again = *terminate = *nominals = *values = *next_given = false;
    *next = 0.0;
    return fmi3OK;
}

EXPORT fmi3Status fmi3CompletedIntegratorStep(fmi3Instance c, fmi3Boolean keep, fmi3Boolean *event, fmi3Boolean *terminate)
{
    (void)c, (void)keep;
    *event = *terminate = false;
    return fmi3OK;
}

EXPORT fmi3Status fmi3SetTime(fmi3Instance c, fmi3Float64 time)
{
    ((body *)c)->time = time;
    return fmi3OK;
}

EXPORT fmi3Status fmi3SetContinuousStates(fmi3Instance c, const fmi3Float64 x[], size_t n)
{
    if (n != STATES) {
        return fmi3Error;
    }
    memcpy(((body *)c)->x, x, sizeof ((body *)c)->x);
    return fmi3OK;
}

EXPORT fmi3Status fmi3GetContinuousStates(fmi3Instance c, fmi3Float64 x[], size_t n)
{
    if (n != STATES) {
        return fmi3Error;
    }
    memcpy(x, ((body *)c)->x, sizeof ((body *)c)->x);
    return fmi3OK;
}

EXPORT fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance c, fmi3Float64 dx[], size_t n)
{
    if (n != STATES) {
        return fmi3Error;
    }
    rates(c, dx);
    return fmi3OK;
}

EXPORT fmi3Status fmi3GetEventIndicators(fmi3Instance c, fmi3Float64 indicators[], size_t n)
{
    (void)c, (void)indicators;
    return n == 0 ? fmi3OK : fmi3Error;
}

EXPORT fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance c, fmi3Float64 nominals[], size_t n)
{
    (void)c;
    if (n != STATES) {
        return fmi3Error;
    }
    nominals_of(nominals);
    return fmi3OK;
}

EXPORT fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance c, size_t *n)
{
    (void)c;
    *n = 0;
    return fmi3OK;
}

EXPORT fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance c, size_t *n)
{
    (void)c;
    *n = STATES;
    return fmi3OK;
}

EXPORT fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 now, fmi3Float64 step, fmi3Boolean keep, fmi3Boolean *event,
                             fmi3Boolean *terminate, fmi3Boolean *early, fmi3Float64 *reached)
{
    (void)keep;
    *event = *terminate = *early = false;
    *reached = now + step;
    return follow(c, now, step) ? fmi3Error : fmi3OK;
}
