"""Reference of spinning.rs: nutation of a body of revolution (moments of the carrier ACROSS and ALONG its axis, spin SPIN about it)
with a spheroidal tank of viscous liquid about its centre of mass. In body axes the motion u of the liquid beside that of the body obeys
du/dt + 2 W x u + dw/dt x r + grad p = nu div grad u. Fields u = curl(g^2 A), g = 1 - s^2/a^2 - z^2/c^2, with polynomials A, keep
the volume and rest at the wall; only those that turn once round the axis couple with the body. Galerkin, so that no pressure is
left and the rates are eigenvalues. numpy and scipy. Prints semi-axes, Reynolds number, decay rate and frequency in body axes (1/s) of
two degrees; they agree to nine digits up to a Reynolds number of 100, to four at 1000; from a degree of 24 on rounding spoils them."""
import numpy as np
from numpy.polynomial import legendre
from scipy.linalg import eig
from scipy.signal import convolve2d

CARRIER, SPIN, DENSITY = (4.0, 6.0), 0.1, 1000.0
WALL = convolve2d(*2 * (np.array([[1, 0, -1], [0, 0, 0], [-1, 0, 0]]),))


def derivative(A, axis):
    return np.polynomial.polynomial.polyder(A, axis=axis)


def times_s(A, power):
    """Multiplied by a power of s, the first index of the coefficients."""
    return np.vstack([np.zeros((power, A.shape[1])), A]) if power > 0 else np.vstack([A, 0 * A[:1]])[-power:]


def total(*terms):
    shape = np.max([A.shape for A in terms], axis=0)
    return sum(np.pad(A, [(0, m - n) for m, n in zip(shape, A.shape)]) for A in terms)


def potentials(degree):
    """Components (s, phi, z) of the vector potentials that turn once round the axis."""
    none = np.zeros((1, 1))
    for kind, power in (("axial", 1), ("forwards", 0), ("backwards", 2)):
        for i in range(degree // 2 + 1):
            for j in range(degree + 1 - 2 * i - power):
                A = np.outer(legendre.leg2poly([0] * 2 * i + [1]), legendre.leg2poly([0] * j + [1]))
                A = convolve2d(WALL, times_s(A, power) if power else A)
                yield {"axial": (none, none, A), "forwards": (A, 1j * A, none), "backwards": (A, -1j * A, none)}[kind]


def curl(A, a, c):
    A_s, A_phi, A_z = A
    u_s = total(1j * times_s(A_z, -1) / a, -derivative(A_phi, 1) / c)
    u_phi = total(derivative(A_s, 1) / c, -derivative(A_z, 0) / a)
    u_z = times_s(total(derivative(times_s(A_phi, 1), 0), -1j * A_s), -1) / a
    return u_s, u_phi, u_z


def nutation(a, c, viscosity, degree):
    x, weight = legendre.leggauss(degree + 8)
    radius, cosine = (axis.ravel() for axis in np.meshgrid((x + 1) / 2, x, indexing="ij"))
    s, z = radius * np.sqrt(1 - cosine**2), radius * cosine
    w = np.pi * a * a * c * (np.outer(weight, weight).ravel()) * radius**2
    at = lambda A: np.polynomial.polynomial.polyval2d(s, z, A)
    fields, gradients = [], []
    for A in potentials(degree):
        u_s, u_phi, u_z = curl(A, a, c)
        fields.append([at(u_s), at(u_phi), at(u_z)])
        rows = []
        for component, turns in ((total(u_s, 1j * u_phi) / 2**0.5, 2), (total(u_s, -1j * u_phi) / 2**0.5, 0), (u_z, 1)):
            rows += [at(derivative(component, 0)) / a, at(derivative(component, 1)) / c, turns * at(component) / (a * s)]
        gradients.append(rows)
    U, G = np.array(fields), np.array(gradients)
    _, size, rows = np.linalg.svd((U * np.sqrt(w)).reshape(len(U), -1).T, full_matrices=False)
    keep = size > 1e-9 * size[0]
    basis = rows.conj().T[:, keep] / size[keep]
    U, G = np.einsum("bck,bj->jck", U, basis), np.einsum("bck,bj->jck", G, basis)
    inner = lambda f, g: np.einsum("ick,jck,k->ij", f.conj(), g, w)
    coriolis = 2 * SPIN * inner(U, np.stack([-U[:, 1], U[:, 0], 0 * U[:, 2]], 1))
    turning = np.stack([1j * c * z, -c * z, -1j * a * s])[None]
    load, n = inner(U, turning)[:, 0], len(U)
    mass = DENSITY * 4 / 3 * np.pi * a * a * c
    across, along = CARRIER[0] + mass * (a * a + c * c) / 5, CARRIER[1] + mass * 2 * a * a / 5
    momentum = DENSITY * load.conj() / 2
    B, A = np.eye(n + 1, dtype=complex), np.zeros((n + 1, n + 1), complex)
    B[:n, n], B[n, :n], B[n, n] = load, momentum, across
    A[:n, :n] = -coriolis - viscosity * inner(G, G)
    A[n, :n], A[n, n] = 1j * SPIN * momentum, 1j * SPIN * (across - along)
    rates, states = eig(A, B)
    body = across * abs(states[n]) ** 2
    found = rates[np.argmax(body / (body + DENSITY / 2 * (abs(states[:n]) ** 2).sum(0)))]
    return -found.real, abs(found.imag)


if __name__ == "__main__":
    for a, c in ((0.3, 0.3), (0.3, 0.25), (0.3, 0.15), (0.25, 0.35)):
        for reynolds in (0.1, 1.0, 10.0, 100.0, 1000.0):
            for degree in (14, 18):
                print(a, c, reynolds, *nutation(a, c, SPIN * a * a / reynolds, degree))
