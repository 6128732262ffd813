"""Drake: a floating body with a point on three prismatic joints, in continuous time.

Settings with a step switch the error control off: the program's accuracy is a bound for
each step and says little about the end.
"""

import numpy as np
from pydrake.multibody.math import SpatialVelocity
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import (
    FixedOffsetFrame,
    PrismaticJoint,
    PrismaticSpring,
    RigidBody,
    RotationalInertia,
    SpatialInertia,
    UnitInertia,
)
from pydrake.math import RigidTransform
from pydrake.systems.analysis import (
    ApplySimulatorConfig,
    Simulator,
    SimulatorConfig,
)

from measure import Result, Setting, result, timed
from problem import (
    ANCHOR,
    CASES,
    HUB_INERTIA,
    HUB_MASS,
    POINT_MASS,
    START_SPIN,
    hub_start,
)

LARGEST_STEP = 0.1
UNUSED = 1e-3


def plant(case: str) -> tuple[MultibodyPlant, RigidBody, list[PrismaticJoint]]:
    """The multibody model, its hub, and its joints in the order of the body axes."""
    model = MultibodyPlant(0.0)
    model.mutable_gravity_field().set_gravity_vector(np.zeros(3))
    inertia = SpatialInertia.MakeFromCentralInertia(
        HUB_MASS, np.zeros(3), RotationalInertia(*HUB_INERTIA)
    )
    hub = model.AddRigidBody("hub", inertia)
    anchor = FixedOffsetFrame("anchor", hub.body_frame(), RigidTransform(ANCHOR))
    parent = model.AddFrame(anchor)
    joints = []
    for axis in range(3):
        mass = POINT_MASS if axis == 2 else 0.0
        point = SpatialInertia(mass, np.zeros(3), UnitInertia(0, 0, 0))
        body = model.AddRigidBody(f"slider{axis}", point)
        joint = model.AddJoint(
            PrismaticJoint(
                f"slide{axis}",
                parent,
                body.body_frame(),
                np.eye(3)[axis],
                damping=CASES[case].damping,
            )
        )
        model.AddForceElement(PrismaticSpring(joint, 0.0, CASES[case].stiffness))
        joints.append(joint)
        parent = body.body_frame()
    model.Finalize()
    return model, hub, joints


def configuration(setting: Setting) -> SimulatorConfig:
    """Drake's words for a setting."""
    return SimulatorConfig(
        integration_scheme=setting.method,
        accuracy=UNUSED if setting.fixed else setting.value,
        max_step_size=setting.value if setting.fixed else LARGEST_STEP,
        use_error_control=not setting.fixed,
    )


def run(case: str, setting: Setting) -> Result:
    """Advances to the end of the case; the set-up builds the model."""
    (model, hub, joints), setup = timed(lambda: plant(case))
    simulator = Simulator(model)
    ApplySimulatorConfig(configuration(setting), simulator)
    context = simulator.get_mutable_context()
    place, velocity = hub_start()
    model.SetFreeBodyPose(context, hub, RigidTransform(place))
    model.SetFreeBodySpatialVelocity(
        context, hub, SpatialVelocity(START_SPIN, velocity)
    )
    simulator.Initialize()
    _, seconds = timed(lambda: simulator.AdvanceTo(CASES[case].duration))
    to_body = model.EvalBodyPoseInWorld(context, hub).rotation().inverse()
    spin = model.EvalBodySpatialVelocityInWorld(context, hub).rotational()
    q = np.array([joint.get_translation(context) for joint in joints])
    v = np.array([joint.get_translation_rate(context) for joint in joints])
    steps = simulator.get_integrator().get_num_steps_taken()
    return result(to_body.multiply(spin), q, v, seconds, steps, setup)
