#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Receding contact by an integral equation, after L. M. Keer, J. Dundurs and K. C. Tsai, J. Appl. Mech. 39 (1972) 1115: what prm/published/layer.prm is compared with.

A layer 0 < y < 1 on a rigid plane without friction is pressed by 1 where |x| < b on its top. Its base presses with p where |x| < c and is free elsewhere. With the
cosine transforms of both the base has, up to 2 (1 - nu^2)/E,

    v''(x) = -(1/pi) int_0^oo k [A(k) P(k) - B(k) Q(k)] cos kx dk,   A = (sh ch + k)/(sh^2 - k^2),   B = (k ch + sh)/(sh^2 - k^2),   Q = 2 sin(k b)/k,

which vanishes for |x| < c. The moduli cancel: c and p do not depend on them, nor c on the load. With s = x/c, p = sum a_n (1 - s^2)^(1/2) U_2n(s), whose Hilbert transform
is -T_{2n+1}(s), the part A - 1 is smooth. Points of collocation are the zeros of U, and the balance of forces gives c.

receding_layer.py      prints c and p(0) for b = 1/2 with more and more terms"""
import math

import numpy as np

CUT = 60.0  # beyond it A - 1 and B are below e^-60


def kernels(k):
    """A - 1 and B: series where the difference cancels, exponentials where sh overflows."""
    e = np.exp(-2 * k)
    with np.errstate(all="ignore"):
        bottom = (1 - e) ** 2 / 4 - k * k * e
        a = ((1 - e * e) / 4 + k * e) / bottom - 1
        b = np.exp(-k) * (k * (1 + e) + 1 - e) / 2 / bottom
    small = k < 0.05
    x = k[small]
    quotient = x ** 4 / 3 * (1 + 2 * x ** 2 / 15 + x ** 4 / 105)  # sh^2 - k^2 = k^4/3 + 2 k^6/45 + k^8/315
    a[small] = (2 * x + 2 * x ** 3 / 3 + 2 * x ** 5 / 15) / quotient - 1
    b[small] = (2 * x + 2 * x ** 3 / 3 + x ** 5 / 20) / quotient
    return a, b


def layer(b=0.5, n=12):
    """c and p(0) by n terms. For k -> 0 A and B grow like 6/k^3, and A P - B Q does not where P(0) = Q(0): the balance gives the first coefficient, beforehand."""
    k, weights = np.polynomial.legendre.leggauss(800)
    k, weights = (k + 1) * CUT / 2, weights * CUT / 2
    a, transfer = kernels(k)
    theta = (np.arange(400) + 0.5) * math.pi / 400  # s = cos theta: (1 - s^2)^(1/2) U_m(s) ds = sin((m + 1) theta) sin(theta) dtheta
    orders = 2 * np.arange(n)
    angle = (np.arange(n) + 1) * math.pi / (2 * n + 1)  # points of collocation
    Q = 2 * np.sin(k * b) / k

    def missed(c):
        cosines = np.cos(np.outer(k, c * np.cos(theta)))
        P = np.stack([c * cosines @ (np.sin((m + 1) * theta) * np.sin(theta)) * math.pi / 400 for m in orders])
        first = 2 * b / (c * math.pi / 2)  # a_0 of the balance: the other terms carry no force
        at = np.cos(np.outer(k, c * np.cos(angle))) * (k * weights)[:, None]
        # The part 1 of A: (1/pi) int_0^oo k P cos kx dk = -(1/pi) d/dx (finite part of int p/(x - t) dt) = (m + 1) U_m(s)/c.
        singular = np.array([(m + 1) * np.sin((m + 1) * angle) / np.sin(angle) / c for m in orders])
        matrix = singular + (P * a) @ at / math.pi
        right = ((Q * transfer - first * P[0] * a) @ at) / math.pi - first * singular[0]
        # n equations for a_1 ... a_{n-1}: the last one is the condition for c.
        unknown = np.linalg.solve(matrix[1:, :-1].T, right[:-1])
        return unknown @ matrix[1:, -1] - right[-1], np.concatenate([[first], unknown])

    low, high = 0.9, 1.1
    f_low, f_high = missed(low)[0], missed(high)[0]
    for _ in range(60):
        c = high - f_high * (high - low) / (f_high - f_low)
        f, coefficients = missed(c)
        low, f_low, high, f_high = high, f_high, c, f
        if abs(high - low) < 1e-13:
            break
    return c, float(coefficients @ (-1.0) ** np.arange(n))  # U_2n(0) = (-1)^n


if __name__ == "__main__":
    for terms in (4, 6, 8, 10, 12, 16, 20):
        print(terms, "terms: c = {:.10f}, p(0) = {:.10f}".format(*layer(n=terms)))
