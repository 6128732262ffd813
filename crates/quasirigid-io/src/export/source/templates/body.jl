{{heading}}
module {{name}}

using LinearAlgebra: cross, dot, norm

"Start of the model: angular momentum (N m s, body axes) and quaternion."
const START = {{start}}
"Inertia about the centre of mass (kg m^2): xx, yy, zz, yz, zx, xy."
const INERTIA = {{inertia}}
"Mass (kg)."
const MASS = {{mass}}
"Angular momentum of momentum wheels relative to the body (N m s)."
const WHEELS = {{wheels}}
"Spins (rad/s) up to which the equations hold, and from which they fail."
const SPIN_HOLDS = {{spin_holds}}
const SPIN_FAILS = {{spin_fails}}
const LEAST_MOMENT = {{least_moment}}
const NONE = [0.0, 0.0, 0.0]

"Energy (J) at an angular momentum."
energy(K) = (
        {{energy}}
)

energy_gradient(K) = [
        ({{gradient_x}}),
        ({{gradient_y}}),
        ({{gradient_z}}),
]

"The vector c of the energy form."
internal_momenta(K) = [
        ({{c_x}}),
        ({{c_y}}),
        ({{c_z}}),
]

"The tensor T of the energy form."
dissipation(K) = symmetric([
        ({{T_xx}}),
        ({{T_yy}}),
        ({{T_zz}}),
        ({{T_yz}}),
        ({{T_zx}}),
        ({{T_xy}}),
])

symmetric(S) = [S[1] S[6] S[5]; S[6] S[2] S[4]; S[5] S[4] S[3]]

adjugate(S) = hcat(cross(S[:, 2], S[:, 3]), cross(S[:, 3], S[:, 1]), cross(S[:, 1], S[:, 2]))

"Angular velocity (rad/s), rate of the angular momentum (N m), both in body axes, and power dissipated (W)."
function motion(K, torque = NONE)
    gradient, c, T = energy_gradient(K), internal_momenta(K), dissipation(K)
    v = cross(K, gradient)
    a = 1.0 + dot(K, c)
    d = a * a + dot(K, adjugate(T) * K)
    free = (a * v + cross(K, T * v)) / d
    # what the torque adds: (a - K x T)^-1 (M + c K.M)
    m = torque + c * dot(K, torque)
    once = cross(K, T * m)
    twice = cross(K, T * once)
    rate = free + (m + (a * once + twice) / d) / a
    braking = T * rate
    return gradient + cross(c, rate) + braking, rate, dot(rate, braking)
end

"Right-hand side: rates of the state (K, quaternion); for DifferentialEquations.jl: ODEProblem((y, p, t) -> rates(y), START, (0, 60))."
function rates(y, torque = NONE)
    omega, rate, _ = motion(y[1:3], torque)
    v = y[5:7]
    return vcat(rate, -0.5 * dot(v, omega), 0.5 * (y[4] * omega + cross(v, omega)))
end

"Angular momentum with an angular velocity where no torque acts."
function momentum_of(omega)
    J = symmetric(INERTIA)
    K = J * omega + WHEELS
    error_left = Inf
    for _ in 1:200
        gap = omega - motion(K)[1]
        error_left = norm(gap)
        error_left <= 4e-16 * norm(omega) && break
        K = K + J * gap
    end
    error_left <= 1e-12 * norm(omega) || error("no angular momentum has this angular velocity: it is beyond the range of the equations")
    return K
end

"Status of a state: 0 the equations hold, 1 digits are lost, 2 they fail, 3 no number."
function status(y, torque = NONE)
    # the angular acceleration of a torque counts as the square of a spin
    spin = max(norm(motion(y[1:3])[1]), sqrt(norm(torque) / LEAST_MOMENT))
    all(isfinite, y) && isfinite(spin) || return 3
    return (spin >= SPIN_HOLDS) + (spin >= SPIN_FAILS)
end

"Angular momentum, torque; angular velocity, rate of the angular momentum, power, energy."
const TESTS = {{tests}}

"Largest relative difference from quasirigid's own numbers."
function self_test()
    found = map(TESTS) do row
        omega, rate, power = motion(row[1:3], row[4:6])
        vcat(omega, rate, power, energy(row[1:3]))
    end
    groups = [1:3, 4:6, 7:7, 8:8]
    return maximum(groups) do group
        apart = maximum(maximum(abs.(now[group] - row[6 .+ group])) for (now, row) in zip(found, TESTS))
        apart / max(maximum(maximum(abs.(row[6 .+ group])) for row in TESTS), 1e-300)
    end
end

end
