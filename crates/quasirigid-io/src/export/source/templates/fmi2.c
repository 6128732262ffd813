/* FMI 2.0, model exchange and co-simulation: types, names and numbers are those of the standard. */
#include "fmi-unit.h"

typedef void *fmi2Component;
typedef unsigned int fmi2ValueReference;
typedef double fmi2Real;
typedef int fmi2Integer;
typedef int fmi2Boolean;
typedef char fmi2Char;
typedef const fmi2Char *fmi2String;
typedef char fmi2Byte;
typedef void *fmi2FMUstate;
typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef enum { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;
typedef enum { fmi2DoStepStatus, fmi2PendingStatus, fmi2LastSuccessfulTime, fmi2Terminated } fmi2StatusKind;
typedef struct {
    fmi2Boolean newDiscreteStatesNeeded;
    fmi2Boolean terminateSimulation;
    fmi2Boolean nominalsOfContinuousStatesChanged;
    fmi2Boolean valuesOfContinuousStatesChanged;
    fmi2Boolean nextEventTimeDefined;
    fmi2Real nextEventTime;
} fmi2EventInfo;

EXPORT const char *fmi2GetTypesPlatform(void)
{
    return "default";
}

EXPORT const char *fmi2GetVersion(void)
{
    return "2.0";
}

EXPORT fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String categories[])
{
    (void)c, (void)on, (void)n, (void)categories;
    return fmi2OK;
}

EXPORT fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                                     const void *functions, fmi2Boolean visible, fmi2Boolean logging)
{
    (void)name, (void)type, (void)resources, (void)functions, (void)visible, (void)logging;
    return instance(guid);
}

EXPORT void fmi2FreeInstance(fmi2Component c)
{
    free(c);
}

EXPORT fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean tolerance_given, fmi2Real tolerance, fmi2Real start,
                                      fmi2Boolean stop_given, fmi2Real stop)
{
    (void)tolerance_given, (void)tolerance, (void)stop_given, (void)stop;
    ((body *)c)->time = start;
    return fmi2OK;
}

/* Changes of mode that need nothing. */
#define NOTHING(name)                    \
    EXPORT fmi2Status name(fmi2Component c) \
    {                                    \
        (void)c;                         \
        return fmi2OK;                   \
    }

NOTHING(fmi2EnterInitializationMode)
NOTHING(fmi2ExitInitializationMode)
NOTHING(fmi2Terminate)
NOTHING(fmi2EnterEventMode)
NOTHING(fmi2EnterContinuousTimeMode)

EXPORT fmi2Status fmi2Reset(fmi2Component c)
{
    reset(c);
    return fmi2OK;
}

EXPORT fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Real value[])
{
    return get_reals(c, vr, n, value) ? fmi2Error : fmi2OK;
}

EXPORT fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Real value[])
{
    return set_reals(c, vr, n, value) ? fmi2Error : fmi2OK;
}

EXPORT fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Boolean value[])
{
    size_t i;

    for (i = 0; i < n; i++) {
        if (vr[i] != VALID) {
            return fmi2Error;
        }
        value[i] = is_valid(c);
    }
    return fmi2OK;
}

/* Types of variables that this body has none of, or none that are set. */
#define NONE_OF(name, type)                                                                   \
    EXPORT fmi2Status name(fmi2Component c, const fmi2ValueReference vr[], size_t n, type value) \
    {                                                                                         \
        (void)c, (void)vr, (void)value;                                                       \
        return n == 0 ? fmi2OK : fmi2Error;                                                   \
    }

NONE_OF(fmi2GetInteger, fmi2Integer *)
NONE_OF(fmi2SetInteger, const fmi2Integer *)
NONE_OF(fmi2SetBoolean, const fmi2Boolean *)
NONE_OF(fmi2GetString, fmi2String *)
NONE_OF(fmi2SetString, const fmi2String *)

EXPORT fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    return save(c, state) ? fmi2Error : fmi2OK;
}

EXPORT fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state)
{
    memcpy(c, state, sizeof(body));
    return fmi2OK;
}

EXPORT fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    (void)c;
    free(*state);
    *state = NULL;
    return fmi2OK;
}

EXPORT fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    (void)c, (void)state;
    *size = sizeof(body);
    return fmi2OK;
}

EXPORT fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    (void)c;
    if (size != sizeof(body)) {
        return fmi2Error;
    }
    memcpy(bytes, state, size);
    return fmi2OK;
}

EXPORT fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state)
{
    if (size != sizeof(body) || fmi2GetFMUstate(c, state) != fmi2OK) {
        return fmi2Error;
    }
    memcpy(*state, bytes, size);
    return fmi2OK;
}

EXPORT fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[], size_t unknowns,
                                               const fmi2ValueReference known[], size_t knowns, const fmi2Real seed[],
                                               fmi2Real sensitivity[])
{
    (void)c, (void)unknown, (void)unknowns, (void)known, (void)knowns, (void)seed, (void)sensitivity;
    return fmi2Error;
}

EXPORT fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *info)
{
    (void)c;
    memset(info, 0, sizeof *info);
    return fmi2OK;
}

EXPORT fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean keep, fmi2Boolean *event, fmi2Boolean *terminate)
{
    (void)c, (void)keep;
    *event = 0;
    *terminate = 0;
    return fmi2OK;
}

EXPORT fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time)
{
    ((body *)c)->time = time;
    return fmi2OK;
}

EXPORT fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t n)
{
    if (n != STATES) {
        return fmi2Error;
    }
    memcpy(((body *)c)->x, x, sizeof ((body *)c)->x);
    return fmi2OK;
}

EXPORT fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real dx[], size_t n)
{
    if (n != STATES) {
        return fmi2Error;
    }
    rates(c, dx);
    return fmi2OK;
}

EXPORT fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real indicators[], size_t n)
{
    (void)c, (void)indicators;
    return n == 0 ? fmi2OK : fmi2Error;
}

EXPORT fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t n)
{
    if (n != STATES) {
        return fmi2Error;
    }
    memcpy(x, ((body *)c)->x, sizeof ((body *)c)->x);
    return fmi2OK;
}

EXPORT fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real nominals[], size_t n)
{
    (void)c;
    if (n != STATES) {
        return fmi2Error;
    }
    nominals_of(nominals);
    return fmi2OK;
}

EXPORT fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                              const fmi2Integer order[], const fmi2Real value[])
{
    (void)c, (void)vr, (void)order, (void)value;
    return n == 0 ? fmi2OK : fmi2Error;
}

EXPORT fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                               const fmi2Integer order[], fmi2Real value[])
{
    (void)c, (void)vr, (void)order, (void)value;
    return n == 0 ? fmi2OK : fmi2Error;
}

EXPORT fmi2Status fmi2DoStep(fmi2Component c, fmi2Real now, fmi2Real step, fmi2Boolean final)
{
    (void)final;
    return follow(c, now, step) ? fmi2Error : fmi2OK;
}

EXPORT fmi2Status fmi2CancelStep(fmi2Component c)
{
    (void)c;
    return fmi2Error;
}

/* Nothing is pending: every step ends before it returns. */
#define NO_STATUS(name, type)                                                \
    EXPORT fmi2Status name(fmi2Component c, const fmi2StatusKind kind, type value) \
    {                                                                        \
        (void)c, (void)kind, (void)value;                                    \
        return fmi2Discard;                                                  \
    }

NO_STATUS(fmi2GetStatus, fmi2Status *)
NO_STATUS(fmi2GetIntegerStatus, fmi2Integer *)
NO_STATUS(fmi2GetBooleanStatus, fmi2Boolean *)
NO_STATUS(fmi2GetStringStatus, fmi2String *)

EXPORT fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    if (kind != fmi2LastSuccessfulTime) {
        return fmi2Discard;
    }
    *value = ((body *)c)->time;
    return fmi2OK;
}
