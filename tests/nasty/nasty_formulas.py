#!/usr/bin/env python3
"""Nasty formulas: where a free mass is after some seconds, to 30 digits, or which words end it.

    python3 tests/nasty/nasty_formulas.py > tests/nasty/nasty_formulas.tsv        (mpmath, SymPy; three minutes)

Rows of the second hundred are computed in double precision (1e-12 m), the others in 40 digits.
Independent of the program: every curve stands here once more as pieces that are smooth by hand, and the motion is arc length (dt = ds/v, with
v^2 = v0^2 - 2 g (y - y0) under gravity), integrated and inverted by mpmath. Creased planes are unfolded, on paper.
Columns: name, kind, x, y, z, at, rate, gravity_y, seconds, verdict (right | stopped | refused), x_m, y_m, z_m, words. For `stopped` the
place is given where it is known; `words` must stand in the sentence."""
import sys
import mpmath as mp
import sympy as sp
mp.mp.dps = 40
P = sp.Symbol('phi')
C, WORDS, NEAR = mp, 'mpmath', mp.mpf(10) ** -28  # what is computed with
INF = 1e9


def piece_functions(texts):
    e = [sp.sympify(t, {'phi': P, 'e': sp.E}) for t in texts]
    return sp.lambdify(P, e, WORDS), sp.lambdify(P, [sp.diff(c, P) for c in e], WORDS)


def solve(pieces, at, rate, T, g=0, marks=()):
    """phi after T on pieces [(upper bound, x, y, z)], moving one way."""
    fs = [(C.mpf(hi), *piece_functions(t)) for hi, t in pieces]
    at, rate, T = C.mpf(at), C.mpf(rate), C.mpf(T)

    def of(phi, side):
        for hi, r, d in fs:
            if phi < hi or (phi == hi and side < 0):
                return r, d
        return fs[-1][1:]
    up = 1 if rate > 0 else -1
    r0, d0 = of(at, up)
    speed0 = C.sqrt(sum(c * c for c in d0(at))) * abs(rate)
    y0 = r0(at)[1]

    def time(a, b):  # within one piece
        r, d = of((a + b) / 2, 1)
        f = lambda p: C.sqrt(sum(c * c for c in d(p))) / C.sqrt(speed0 ** 2 - 2 * C.mpf(g) * (r(p)[1] - y0))
        return abs(C.quad(f, [a, (a + b) / 2, b]))
    cuts = sorted([hi for hi, *_ in fs if hi < INF] + [C.mpf(m) for m in marks], reverse=up < 0)
    cuts = [c for c in cuts if (c - at) * up > 0]
    here, left, step = at, T, abs(rate) * T / 64
    for _ in range(100000):
        ahead = here + up * step
        for c in cuts:
            if (c - here) * up > 0 and (ahead - c) * up > 0:
                ahead = c
        t = time(here, ahead)
        if t >= left:
            break
        left -= t
        here = ahead
    lo, hi = here, ahead
    r, d = of((lo + hi) / 2, 1)
    phi = lo + (hi - lo) * left / t
    for _ in range(200):  # Newton, kept between the bounds
        miss = time(here, phi) - left
        if abs(miss) < NEAR:
            break
        if miss * 1 > 0:
            hi = phi
        else:
            lo = phi
        slope = C.sqrt(sum(c * c for c in d(phi))) / C.sqrt(speed0 ** 2 - 2 * C.mpf(g) * (r(phi)[1] - y0))
        better = phi - up * miss / slope if slope > 0 else (lo + hi) / 2
        phi = better if min(lo, hi) <= better <= max(lo, hi) else (lo + hi) / 2
    return [c for c in of(phi, up)[0](phi)]


rows = []


def right(name, formula, at, rate, T, pieces=None, g=0, marks=()):
    r = solve(pieces or [(INF, [f.replace('^', '**') for f in formula])], at, rate, T, g, marks)
    rows.append([name, 'curve', *formula, at, rate, -g, T, 'right', *[mp.nstr(mp.chop(c, mp.mpf(10) ** -30), 20) for c in r], ''])
    print(name, file=sys.stderr)


def stopped(name, formula, at, rate, T, words, place=None, kind='curve', g=0):
    rows.append([name, kind, *formula, at, rate, -g, T, 'stopped', *(place or ['', '', '']), words])


def refused(name, formula, at, rate, T, words, kind='curve'):
    rows.append([name, kind, *formula, at, rate, 0, T, 'refused', '', '', '', words])


def known(name, formula, at, rate, T, place, kind='surface'):
    rows.append([name, kind, *formula, at, rate, 0, T, 'right', *place, ''])


def both(lo, hi, at=0):  # pieces below and above a place
    return [(at, lo), (INF, hi)]


x = 'phi/10'
# kinks
right('roof', [x, '0.05*abs(phi)', '0'], -1, 3, 1.7, both([x, '-0.05*phi', '0'], [x, '0.05*phi', '0']))
right('steep roof', [x, '0.3*abs(phi)', '0'], -1, 3, 1.7, both([x, '-0.3*phi', '0'], [x, '0.3*phi', '0']))
right('speed jumps by 3', ['phi/10 + abs(phi)/20', '0', '0'], -1, 2, 1.3, both(['phi/20', '0', '0'], ['3*phi/20', '0', '0']))
right('speed and direction jump', ['phi + abs(phi)', '0.2*abs(phi)', '0'], -1, 2, 1.3,
      both(['0', '-0.2*phi', '0'], ['2*phi', '0.2*phi', '0']))
right('|sin| arcade', ['0.1*phi', '0.1*abs(sin(phi))', '0'], 0.5, 3, 2, [(k * sp.pi.evalf(45), ['0.1*phi', f'{(-1)**(k-1)}*sin(phi)/10', '0']) for k in range(1, 9)])
right('two kinks', [x, '0.1*abs(abs(phi) - 1)', '0'], -2, 3, 1.9, [(-1, [x, '(-phi - 1)/10', '0']), (0, [x, '(1 + phi)/10', '0']), (1, [x, '(1 - phi)/10', '0']), (INF, [x, '(phi - 1)/10', '0'])])
right('narrow notch 1e-6', [x, '0.05*abs(abs(phi) - 1e-6)', '0'], -1, 1, 1.5, [(-mp.mpf('1e-6'), [x, '(-phi - 10**(-6))/20', '0']), (0, [x, '(phi + 10**(-6))/20', '0']), (mp.mpf('1e-6'), [x, '(10**(-6) - phi)/20', '0']), (INF, [x, '(phi - 10**(-6))/20', '0'])])
right('abs by a root of a square', [x, '0.1*sqrt((phi - 1)^2)', '0'], 0, 1.5, 1.5, both([x, '(1 - phi)/10', '0'], [x, '(phi - 1)/10', '0'], 1))
right('a ramp that begins', [x, '0.1*abs(abs(phi) + phi)', '0'], -1, 2, 1.2, both([x, '0', '0'], [x, 'phi/5', '0']))
right('sign times phi', [x, '0.05*sign(phi)*phi', '0'], -1, 2, 1.2, both([x, '-phi/20', '0'], [x, 'phi/20', '0']))
right('zigzag helix', ['0.1*cos(phi)', '0.1*sin(phi)', '0.05*abs(phi - 2)'], 0, 2, 2.5, both(['cos(phi)/10', 'sin(phi)/10', '(2 - phi)/20'], ['cos(phi)/10', 'sin(phi)/10', '(phi - 2)/20'], 2))
right('kink downhill', [x, '0.1*abs(phi)', '0'], -2, 2, 0.45, both([x, '-phi/10', '0'], [x, 'phi/10', '0']), g=9.81)
right('kink over a ridge', [x, '-0.1*abs(phi)', '0'], -1, 30, 0.5, both([x, 'phi/10', '0'], [x, '-phi/10', '0']), g=9.81)
right('asin of sin', [x, '0.1*asin(sin(phi))', '0'], 0, 3, 2, [(sp.pi.evalf(45) / 2, [x, 'phi/10', '0']), (3 * sp.pi.evalf(45) / 2, [x, '(pi - phi)/10', '0']), (INF, [x, '(phi - 2*pi)/10', '0'])])
# bends
right('parabolas of two signs', [x, '0.1*phi*abs(phi)', '0'], -1, 2, 1.2, both([x, '-phi**2/10', '0'], [x, 'phi**2/10', '0']))
right('clothoid that begins', [x, '0.1*(phi + abs(phi))^3', '0'], -1, 1, 1.9, both([x, '0', '0'], [x, '8*phi**3/10', '0']))
# no place after all
right('atan2 undone', [x, '0.1*cos(atan2(sin(phi), cos(phi)))', '0'], 0.2, 3, 2, [(INF, [x, 'cos(phi)/10', '0'])])
right('abs of what is positive', [x, '0.1*abs(2 + sin(phi))', '0'], 0.2, 3, 2, [(INF, [x, '(2 + sin(phi))/10', '0'])])
right('root of what is positive', [x, '0.1*sqrt(1 + phi^2)', '0'], -3, 2, 2.5)
right('witch', [x, '0.1/(1 + phi^2)', '0'], -3, 2, 2.5)
right('sech', [x, '0.1/cosh(3*phi)', '0'], -2, 2, 2)
right('logistic', [x, '0.1/(1 + exp(-8*phi))', '0'], -1, 1, 2)
# holes
right('sinc', [x, '0.1*sin(phi)/phi', '0'], -2, 1.3, 2.5, [(0, [x, 'sin(phi)/phi/10', '0']), (INF, [x, 'sin(phi)/phi/10', '0'])])
refused('(1 - cos)/phi', [x, '0.1*(1 - cos(phi))/phi', '0'], -2, 1.3, 2.5, 'the formula loses its digits there')
right('tan(phi)/phi', [x, '0.1*tan(phi)/phi', '0'], -1, 0.8, 1.7, [(0, [x, 'tan(phi)/phi/10', '0']), (INF, [x, 'tan(phi)/phi/10', '0'])])
# cusps, folds, standstills
right('astroid', ['0.1*cos(phi)^3', '0.1*sin(phi)^3', '0'], 0.4, 2, 3, marks=[sp.pi.evalf(45) * k / 2 for k in range(1, 12)])
right('cuspidal cubic', ['0.1*phi^2', '0.1*phi^3', '0'], -1, 1, 1.1, marks=[0])
right('cycloid', ['0.05*(phi - sin(phi))', '0.05*(1 - cos(phi))', '0'], 2, 3, 2.5, marks=[sp.pi.evalf(45) * 2 * k for k in range(1, 5)])
right('folded line', ['0.1*cos(phi)', '0', '0'], 0.5, 2, 3, marks=[sp.pi.evalf(45) * k for k in range(1, 12)])
right('folded parabola', ['0.1*phi^2', '0.1*phi^4', '0'], -1, 1, 1, marks=[0])
right('standstill', ['0.1*phi^3', '0.05*phi^3', '0'], -1, 0.6, 1, marks=[0])
right('near cusp 1e-3', ['0.1*(cos(phi) + 0.999*cos(2*phi)/2)', '0.1*(sin(phi) + 0.999*sin(2*phi)/2)', '0'], 1, 2, 2.5)
right('near cusp 1e-6', ['0.1*(cos(phi) + 0.999999*cos(2*phi)/2)', '0.1*(sin(phi) + 0.999999*sin(2*phi)/2)', '0'], 1, 2, 2.5)
# scales
right('a micrometre', ['1e-6*cos(phi)', '1e-6*sin(phi)', '1e-7*phi'], 0, 4, 2, [(INF, ['cos(phi)/10**6', 'sin(phi)/10**6', 'phi/10**7'])])
right('a kilometre', ['1000*cos(phi)', '500*sin(phi)', '0'], 0.3, 0.02, 2)
right('phi in micrometres', ['1e-6*phi', '0.05*sin(1e-5*phi)', '0'], 0, 3e5, 2, [(INF, ['phi/10**6', 'sin(phi/10**5)/20', '0'])])
right('phi in metres', ['phi', '0.1*sin(20*phi)', '0'], -0.1, 0.15, 2)
right('a kink on the kilometre', ['100*phi', '50*abs(phi - 1)', '0'], 0, 1.5, 1.2, both(['100*phi', '50*(1 - phi)', '0'], ['100*phi', '50*(phi - 1)', '0'], 1))
# smooth, but wild
right('spike of a gaussian', [x, '0.1*exp(-(phi/0.01)^2)', '0'], -1, 1, 1.7, [(INF, [x, 'exp(-10000*phi**2)/10', '0'])], marks=[mp.mpf(k) / 200 for k in range(-16, 17)])
right('narrow bump 1e-3', [x, '0.01*exp(-(1000*(phi - 0.5))^2)', '0'], 0, 0.5, 1.7, [(INF, [x, 'exp(-1000000*(phi - sp2)**2)/100'.replace('sp2', '(1/2)').replace('(1/2)', 'Rational(1,2)'), '0'])], marks=[mp.mpf('0.5') + mp.mpf(k) / 2000 for k in range(-16, 17)])
right('fast wiggle', [x, '0.01*sin(50*phi)', '0'], 0, 0.5, 1.5)
right('chirp', [x, '0.02*sin(phi^2)', '0'], 0.1, 3, 2.5)
right('high power', [x, '0.1*phi^9', '0'], -1, 0.4, 1.5)
right('tower', ['0.1*cos(sin(3*cos(phi)))', '0.1*sin(sin(3*phi))', '0.05*cos(2*phi)'], 0.3, 1, 2)
right('nearly straight', [x, '1e-9*sin(phi)', '0'], 0, 2, 2, [(INF, [x, 'sin(phi)/10**9', '0'])])
right('nearly closed', ['0.1*cos(phi)', '0.1*sin(phi)', '1e-8*phi'], 0.1, 3, 3, [(INF, ['cos(phi)/10', 'sin(phi)/10', 'phi/10**8'])])
right('self-crossing', ['0.1*sin(phi)', '0.1*sin(2*phi)', '0'], 0.3, 2, 3)
right('flat ellipse 1:1000', ['0.1*cos(phi)', '1e-4*sin(phi)', '0'], 1, 2, 2, [(INF, ['cos(phi)/10', 'sin(phi)/10**4', '0'])], marks=[sp.pi.evalf(45) * k for k in range(1, 9)])
right('cornu by its tangent', ['0.1*sin(phi^2)', '0.1*cos(phi^2)', '0.1*phi'], 0.1, 2, 1.5)
right('tan between poles', [x, '0.1*tan(phi)', '0'], -1, 0.9, 1.4)
right('cosh', [x, '0.05*cosh(phi)', '0'], -2, 1.5, 2)
right('oscillating tail', [x, '0.1*exp(-phi)*sin(8*phi)', '0'], 0, 1, 2)
# never crossed
stopped('step', [x, '0.05*sign(phi)', '0'], -1, 3, 2, 'jump at phi = 0: sign(phi)', ['0', '-0.05', '0'])
stopped('sawtooth', [x, '0.1*atan2(sin(phi), cos(phi))', '0'], 0, 3, 2, 'jump at phi = 3.14159265: atan2(sin(phi), cos(phi))', [mp.nstr(mp.pi / 10, 20)] * 2 + ['0'])
stopped('sawtooth by atan(tan)', [x, '0.1*atan(tan(phi))', '0'], 0, 3, 2, 'jump at phi = 1.57079633')
stopped('well of a logarithm', [x, '0.1*log(abs(phi - 1))', '0'], 0.5, 3, 20, 'pole at phi = 1')
right('towards the pole of 1/phi', [x, '0.1/phi', '0'], 1, -3, 20)
stopped('root that ends', [x, '0.1*sqrt(phi)', '0'], 1, -3, 2, 'end at phi = 0: sqrt(phi)', ['0', '0', '0'])
stopped('asin', [x, '0.1*asin(phi)', '0'], 0, 3, 2, 'end at phi = 1: asin(phi)')
stopped('power that ends', [x, '0.1*phi^2.5', '0'], 1, -3, 2, 'end at phi = 0: phi^2.5')
stopped('root of abs', [x, '0.1*sqrt(abs(phi))', '0'], -1, 3, 2, 'spike at phi = 0')
stopped('x to the x', [x, '0.1*phi^phi', '0'], 1, -3, 2, 'end at phi = 0: phi^phi')
refused('start beyond a root', [x, '0.1*sqrt(phi)', '0'], -1, 3, 2, 'no place for a mass at the start')
refused('start on a pole', [x, '0.1/phi', '0'], 0, 3, 2, 'no place for a mass at the start')
refused('start on a cusp', ['0.1*phi^2', '0.1*phi^3', '0'], 0, 1, 2, 'is a cusp')
refused('start on a fold', ['0.1*cos(phi)', '0', '0'], 0, 1, 2, 'is a fold')
refused('does not move', ['0.1', '0.2', '0.3'], 0, 1, 2, 'degenerates everywhere')
# surfaces
s = mp.sqrt(2)
# A roof z = |u|/10 of slope 1 over x = u/10: unfolded, the way is straight.
known('roof of two planes', ['u/10', 'abs(u)/10', 'v/10'], '-1,0', '1,0.5', 2, ['0.1', '0.1', '0.1'])
known('oblique crease', ['u/10', '(u + v)/10', 'v/10 + abs(u - v)'], '0.5,0', '0.1,0.1', 1, ['0.06', '0.07', '0.51'])
stopped('two sheets', ['u/10', 'v/10', '0.1*sign(u)'], '-1,0', '3,0', 2, 'sign(u)', ['0', '0', '-0.1'], kind='surface')
stopped('rim of a cap of radius 1', ['u', 'sqrt(1 - u^2 - v^2)', 'v'], '0,0', '0.5,0.1', 6, 'sqrt(', kind='surface')
stopped('rim of a cap of 0.1', ['u', 'sqrt(0.01 - u^2 - v^2)', 'v'], '0,0', '0.05,0.01', 6, 'sqrt(', kind='surface')
stopped('well on a surface', ['u/10', '0.1*log(u^2 + v^2)', 'v/10'], '1,0', '-1,0', 60, 'log(', kind='surface')
# A sphere with a bump that no grid of samples sees is no quadric; the way round it is the great circle.
c, w = mp.cos(mp.mpf('0.6')), mp.sin(mp.mpf('0.6'))
known('sphere with a hidden bump', ['(0.1 + 0.01*exp(-1e8*((u - 1)^2 + (v - 1)^2)))*cos(u)*cos(v)', '(0.1 + 0.01*exp(-1e8*((u - 1)^2 + (v - 1)^2)))*sin(v)', '(0.1 + 0.01*exp(-1e8*((u - 1)^2 + (v - 1)^2)))*sin(u)*cos(v)'], '0,0', '0.3,0', 2, [mp.nstr(c / 10, 20), '0', mp.nstr(w / 10, 20)])
known('sphere', ['0.1*cos(u)*cos(v)', '0.1*sin(v)', '0.1*sin(u)*cos(v)'], '0,0', '0.3,0', 2, [mp.nstr(c / 10, 20), '0', mp.nstr(w / 10, 20)])
known('sphere through its pole', ['0.1*sin(v)*cos(u)', '0.1*sin(v)*sin(u)', '0.1*cos(v)'], '0,1', '0,-1', 2, [mp.nstr(mp.sin(-1) / 10, 20), '0', mp.nstr(mp.cos(1) / 10, 20)])

# A second hundred, in double precision (tanh-sinh quadrature): right to 1e-12 m, in seconds instead of minutes.
C, WORDS, NEAR = mp.fp, 'math', 1e-15
PI = sp.pi.evalf(45)
MANY = range(1, 12)
right('nested abs', [x, '0.05*abs(abs(phi) - abs(phi - 1))', '0'], -1, 2, 1.4, [(0, [x, '1/Integer(20)', '0']), (mp.mpf('0.5'), [x, '(1 - 2*phi)/20', '0']), (1, [x, '(2*phi - 1)/20', '0']), (INF, [x, '1/Integer(20)', '0'])])
right('acos of cos', [x, '0.1*acos(cos(phi))', '0'], 0.5, 3, 2, [(PI, [x, 'phi/10', '0']), (2 * PI, [x, '(2*pi - phi)/10', '0']), (3 * PI, [x, '(phi - 2*pi)/10', '0']), (INF, [x, '(4*pi - phi)/10', '0'])])
right('root of a square of a sine', [x, '0.1*sqrt(sin(phi)^2)', '0'], 0.5, 3, 2, [(k * PI, [x, f'{(-1)**(k-1)}*sin(phi)/10', '0']) for k in range(1, 9)])
right('sine made even', [x, '0.1*sign(phi)*sin(phi)', '0'], -1, 2, 1.2, both([x, '-sin(phi)/10', '0'], [x, 'sin(phi)/10', '0']))
right('cube of abs', [x, '0.1*abs(phi)^3', '0'], -1, 1, 1.6, both([x, '-phi**3/10', '0'], [x, 'phi**3/10', '0']))
right('a kink at phi = 1000', [x, '0.1*abs(phi - 1000)', '0'], 999, 2, 1.2, both([x, '(1000 - phi)/10', '0'], [x, '(phi - 1000)/10', '0'], 1000))
right('kinks of two coordinates', ['0.1*abs(phi)', '0.1*abs(phi - 1)', '0.01*phi'], -1, 2, 1.6, [(0, ['-phi/10', '(1 - phi)/10', 'phi/100']), (1, ['phi/10', '(1 - phi)/10', 'phi/100']), (INF, ['phi/10', '(phi - 1)/10', 'phi/100'])])
right('max by abs', [x, '0.05*(phi + 1 + abs(phi - 1))', '0'], 0, 2, 1.1, both([x, '1/Integer(10)', '0'], [x, 'phi/10', '0'], 1))
right('min by abs', [x, '0.05*(phi + 1 - abs(phi - 1))', '0'], 0, 2, 1.1, both([x, 'phi/10', '0'], [x, '1/Integer(10)', '0'], 1))
right('a square to the half', [x, '0.1*(phi^2)^0.5', '0'], -1, 2, 1.2, both([x, '-phi/10', '0'], [x, 'phi/10', '0']))
right('kink in a micrometre', ['1e-6*phi', '1e-6*abs(phi - 1)', '0'], 0, 2, 1.1, both(['phi/10**6', '(1 - phi)/10**6', '0'], ['phi/10**6', '(phi - 1)/10**6', '0'], 1))
right('kink over a kilometre', ['1000*phi', '300*abs(phi - 1)', '0'], 0, 1.5, 1.2, both(['1000*phi', '300*(1 - phi)', '0'], ['1000*phi', '300*(phi - 1)', '0'], 1))
right('abs of a sine under an exponential', [x, '0.1*exp(-abs(phi))', '0'], -1, 2, 1.3, both([x, 'exp(phi)/10', '0'], [x, 'exp(-phi)/10', '0']))
right('kink of a tanh', [x, '0.1*tanh(abs(phi))', '0'], -1, 2, 1.3, both([x, '-tanh(phi)/10', '0'], [x, 'tanh(phi)/10', '0']))
right('kinks of a space curve', ['0.1*cos(phi)', '0.1*abs(sin(phi))', '0.02*phi'], 1, 2, 2, [(PI, ['cos(phi)/10', 'sin(phi)/10', 'phi/50']), (2 * PI, ['cos(phi)/10', '-sin(phi)/10', 'phi/50']), (INF, ['cos(phi)/10', 'sin(phi)/10', 'phi/50'])])
right('kinks a nanometre apart', [x, '0.05*abs(abs(phi) - 1e-8)', '0'], -1, 1, 1.5, [(-mp.mpf('1e-8'), [x, '(-phi - 10**(-8))/20', '0']), (0, [x, '(phi + 10**(-8))/20', '0']), (mp.mpf('1e-8'), [x, '(10**(-8) - phi)/20', '0']), (INF, [x, '(phi - 10**(-8))/20', '0'])])
right('backwards over a kink', [x, '0.2*abs(phi - 0.3)', '0'], 1, -1.5, 1.3, both([x, '(Rational(3,10) - phi)/5', '0'], [x, '(phi - Rational(3,10))/5', '0'], mp.mpf('0.3')))
right('valley under gravity', [x, '0.05*abs(phi)', '0'], -1, 6, 0.25, both([x, '-phi/20', '0'], [x, 'phi/20', '0']), g=9.81)
right('hole of (exp - 1)/phi', [x, '0.1*(exp(phi) - 1)/phi', '0'], 0.3, 1, 1.5, [(INF, [x, '(exp(phi) - 1)/phi/10', '0'])])
right('hole of phi/tan', [x, '0.1*phi/tan(phi)', '0'], -1, 0.8, 1.7, [(0, [x, 'phi/tan(phi)/10', '0']), (INF, [x, 'phi/tan(phi)/10', '0'])])
right('hole of sinh/phi', [x, '0.1*sinh(phi)/phi', '0'], -1, 0.8, 1.7, [(0, [x, 'sinh(phi)/phi/10', '0']), (INF, [x, 'sinh(phi)/phi/10', '0'])])
right('hole of atan/phi', [x, '0.1*atan(phi)/phi', '0'], -1, 0.8, 1.7, [(0, [x, 'atan(phi)/phi/10', '0']), (INF, [x, 'atan(phi)/phi/10', '0'])])
right('hole of a polynomial', [x, '0.1*(phi^2 - 1)/(phi - 1)', '0'], 0, 1, 1.7, [(INF, [x, '(phi + 1)/10', '0'])])
right('phi over phi', [x, '0.1*phi/phi', '0.1*phi^2'], -1, 1, 1.7, [(INF, [x, '1/Integer(10)', 'phi**2/10'])])
right('flat to all orders', [x, '0.1*exp(-1/phi^2)', '0'], 0.3, 1, 1.5, [(INF, [x, 'exp(-1/phi**2)/10', '0'])])
right('deltoid', ['0.05*(2*cos(phi) + cos(2*phi))', '0.05*(2*sin(phi) - sin(2*phi))', '0'], 0.5, 2, 3, marks=[2 * PI * k / 3 for k in MANY])
right('nephroid', ['0.03*(3*cos(phi) - cos(3*phi))', '0.03*(3*sin(phi) - sin(3*phi))', '0'], 0.5, 2, 3, marks=[PI * k for k in MANY])
right('cardioid', ['0.05*(2*cos(phi) - cos(2*phi))', '0.05*(2*sin(phi) - sin(2*phi))', '0'], 0.5, -1, 2, marks=[0])
right('cusp of the second kind', ['0.1*phi^2', '0.1*phi^4 + 0.1*phi^5', '0'], -0.8, 0.7, 1.6, marks=[0])
right('standstill in an inflection', ['0.1*phi^3', '0.1*phi^5', '0'], -0.8, 0.7, 1.1, marks=[0])
right('a step of tanh, 1e-3 wide', [x, '0.05*tanh(1000*phi)', '0'], -1, 1, 1.7, marks=[mp.mpf(k) / 2000 for k in range(-16, 17)])
right('a step of atan, 1e-5 wide', [x, '0.05*atan(1e5*phi)', '0'], -0.5, 1, 1, [(INF, [x, 'atan(100000*phi)/20', '0'])], marks=[mp.mpf(k) * mp.mpf(10) ** e for e in (-6, -5, -4, -3, -2) for k in (-5, -2, -1, 1, 2, 5)] + [0])
right('a Runge needle', [x, '0.05/(1 + 1e6*phi^2)', '0'], -1, 1, 1.5, [(INF, [x, '1/(1 + 1000000*phi**2)/20', '0'])], marks=[mp.mpf(k) * mp.mpf(10) ** e for e in (-4, -3, -2) for k in (-5, -2, -1, 1, 2, 5)] + [0])
right('phi to the 20th', [x, '0.1*phi^20', '0'], -0.9, 0.5, 1.5)
right('five sines deep', [x, '0.1*sin(2*sin(2*sin(2*sin(2*sin(phi)))))', '0'], 0, 0.2, 1.5)
right('a damped chirp', [x, '0.05*exp(-phi^2/4)*cos(phi^3)', '0'], -1.5, 1, 1.5)
right('sinc of a square', [x, '0.1*sin(phi^2)/(1 + phi^2)', '0'], -2, 1, 2)
right('two scales', [x, '0.1*sin(phi) + 1e-4*sin(300*phi)', '0'], 0, 0.7, 1, [(INF, [x, 'sin(phi)/10 + sin(300*phi)/10000', '0'])])
right('lissajous 3:7', ['0.1*sin(3*phi)', '0.1*sin(7*phi + 0.3)', '0'], 0, 0.4, 2, [(INF, ['sin(3*phi)/10', 'sin(7*phi + Rational(3,10))/10', '0'])])
right('rose of five', ['0.1*cos(5*phi)*cos(phi)', '0.1*cos(5*phi)*sin(phi)', '0'], 0.1, 0.5, 2)
right('logarithmic spiral', ['0.05*exp(0.3*phi)*cos(phi)', '0.05*exp(0.3*phi)*sin(phi)', '0'], 0, 2, 2, [(INF, ['exp(3*phi/10)*cos(phi)/20', 'exp(3*phi/10)*sin(phi)/20', '0'])])
right('hyperbolic spiral', ['0.1*cos(phi)/phi', '0.1*sin(phi)/phi', '0'], 1, 1, 3)
right('a knot', ['0.05*(2 + cos(3*phi))*cos(2*phi)', '0.05*(2 + cos(3*phi))*sin(2*phi)', '0.05*sin(3*phi)'], 0.2, 1, 2)
right('a power of an exponential', [x, '0.01*2^(3*phi)', '0'], -1, 1, 1.5, [(INF, [x, '2**(3*phi)/100', '0'])])
right('a power by a number that is whole', [x, '0.1*phi^2.0', '0'], -1, 1, 1.5, [(INF, [x, 'phi**2/10', '0'])])
right('x to the x above 0', [x, '0.1*phi^phi', '0'], 0.2, 1, 1.5, [(INF, [x, 'phi**phi/10', '0'])])
right('atan2 on its smooth side', [x, '0.1*atan2(phi, 2 + cos(phi))', '0'], -2, 1.5, 2, [(INF, [x, 'atan(phi/(2 + cos(phi)))/10', '0'])])
right('hypot by a root', [x, '0.1*sqrt(phi^2 + 1e-6)', '0'], -1, 1, 1.5, [(INF, [x, 'sqrt(phi**2 + Rational(1, 1000000))/10', '0'])], marks=[mp.mpf(k) * mp.mpf(10) ** e for e in (-4, -3, -2) for k in (-5, -2, -1, 1, 2, 5)] + [0])
right('down a logarithm', [x, '0.1*log(phi)', '0'], 1, -0.5, 2)
right('up a tangent', [x, '0.05*tan(phi)', '0'], 0.5, 1, 2)
right('catenary under gravity', [x, '0.05*cosh(2*phi)', '0'], -1, 1, 0.3, g=9.81)
right('ellipse under gravity', ['0.1*cos(phi)', '0.06*sin(phi)', '0'], 0.1, 25, 1, g=9.81)
right('nearly closed to 1e-12', ['0.1*cos(phi)', '0.1*sin(phi)', '1e-12*phi'], 0.1, 3, 3, [(INF, ['cos(phi)/10', 'sin(phi)/10', 'phi/10**12'])])
right('phi in kilometres', ['1000*phi', '0.1*sin(1e4*phi)', '0'], 0, 2e-4, 1, [(INF, ['1000*phi', 'sin(10000*phi)/10', '0'])])
right('phi in nanometres', ['1e-9*phi', '0.05*sin(1e-8*phi)', '0'], 0, 1e8, 1.5, [(INF, ['phi/10**9', 'sin(phi/10**8)/20', '0'])])
stopped('abs to the 3/2', [x, '0.1*abs(phi)^1.5', '0'], -1, 3, 2, 'at phi = 0')
stopped('phi log phi', [x, '0.1*phi*log(abs(phi))', '0'], -1, 3, 2, 'at phi = 0')
right('exp(1/phi) from above', [x, '0.01*exp(1/phi)', '0'], 1, -1, 5)
stopped('exp(1/phi) from below', [x, '0.1*exp(1/phi)', '0'], -1, 2, 2, 'at phi = 0', ['0', '0', '0'])
stopped('atan(1/phi)', [x, '0.1*atan(1/phi)', '0'], -1, 3, 2, 'jump at phi = 0')
stopped('tanh(1/phi)', [x, '0.1*tanh(1/phi)', '0'], -1, 3, 2, 'jump at phi = 0', ['0', '-0.1', '0'])
stopped('atan2 of equals', [x, '0.05*atan2(phi, phi)', '0.02*phi'], 1, -2, 2, 'jump at phi = 0', ['0', mp.nstr(mp.pi / 80, 20), '0'])
stopped('atan2 of sine and phi', [x, '0.05*atan2(sin(phi), phi)', '0.02*phi'], 1, -2, 2, 'jump at phi = 0', ['0', mp.nstr(mp.pi / 80, 20), '0'])
stopped('square wave', [x, '0.05*sign(sin(phi))', '0'], 1, 3, 2, 'jump at phi = 3.14159265', [mp.nstr(mp.pi / 10, 20), '0.05', '0'])
stopped('cut of atan2', [x, '0.05*atan2(phi, -1)', '0'], 1, -3, 2, 'jump at phi = 0', ['0', mp.nstr(mp.pi / 20, 20), '0'])
stopped('floor by atan and tan', ['0.1*(phi - atan(tan(phi)))', '0.1*phi', '0'], 0, 3, 2, 'jump at phi = 1.57079633')
stopped('acos', [x, '0.1*acos(2*phi)', '0'], 0, 1, 2, 'end at phi = 0.5')
stopped('half circle', ['0.1*phi', '0.1*sqrt(1 - phi^2)', '0'], 0, 1, 4, 'end at phi = 1: sqrt(1 - phi^2)')
stopped('logarithm of a logarithm', [x, '0.1*log(log(phi))', '0'], 3, -1, 100, 'at phi = 1')
stopped('odd root', [x, '0.1*(phi^3)^(1/3)', '0'], 1, -1, 2, 'at phi = 0')
right('secant', [x, '0.1/cos(phi)', '0'], 0, 1, 2)
right('1/phi^2', [x, '0.001/phi^2', '0'], 1, -1, 5)
right('phi to minus a half', [x, '0.01*phi^(-0.5)', '0'], 1, -1, 0.9, [(INF, [x, 'phi**(-Rational(1, 2))/100', '0'])])
stopped('root of a root', [x, '0.1*sqrt(1 - sqrt(phi))', '0'], 0.25, 1, 2, 'at phi = 1')
refused('a curve of finite length', ['0.1*tanh(phi)', '0.1/cosh(phi)', '0'], 0, 1, 3, 'too many sub-steps')
for bad in ('min(phi, 1)', 'max(phi, 0)', 'floor(phi)', 'mod(phi, 2)', 'hypot(phi, 1)'):
    refused(f'{bad} is no word', [x, f'0.1*{bad}', '0'], 0, 1, 1, 'unknown')
refused('a product without its sign', [x, '2phi', '0'], 0, 1, 1, 'unexpected')
refused('a remainder', [x, 'phi % 2', '0'], 0, 1, 1, 'unexpected')
refused('log(0)', [x, '0.1*log(0)', '0'], 0, 1, 1, 'has no finite value')
refused('root of a negative number', [x, '0.1*sqrt(-2)*phi', '0'], 0, 1, 1, 'has no finite value')
refused('odd root of a negative number', [x, '0.1*(-8)^(1/3)', '0'], 0, 1, 1, 'has no finite value')
refused('power of a negative number', [x, '0.1*(-2)^phi', '0'], 0.5, 1, 1, 'no place for a mass at the start')
refused('over nothing', [x, '0.1*phi/(phi - phi)', '0'], 0.5, 1, 1, 'no place for a mass at the start')
refused('start in a gap', [x, '0.1*asin(phi)', '0'], 2, 1, 1, 'no place for a mass at the start')
refused('start on a jump', [x, '0.1*atan(1/phi)', '0'], 0, 1, 1, 'no place for a mass at the start')
known('atan2 on a surface', ['u/10', '0.02*atan2(v, 2 + cos(u))', 'v/10'], '0,0', '1,0', 1, ['0.1', '0', '0'])
stopped('jump of atan2 on a surface', ['u/10', '0.05*atan2(u, u)', 'v/10'], '1,0', '-1,0', 2, 'atan2(u, u)', ['0', mp.nstr(mp.pi / 80, 20), '0'], kind='surface')
stopped('a jump a thousand kilometres away', [x, '0.02*abs(atan2(phi, phi))^2', '1e6'], 1, -2, 2, 'jump at phi = 0', ['0', mp.nstr(mp.pi**2 / 800, 20), '1000000'])

# A third set: other kinds. Closed forms where there are, else quadrature in 40 digits.
C, WORDS, NEAR = mp, 'mpmath', mp.mpf(10) ** -28
from mpmath import mpf


def at_place(*r):
    return [mp.nstr(mp.chop(mpf(c), mpf(10) ** -25), 20) for c in r]


def on_circle(angle):
    return at_place(mp.cos(angle) / 10, mp.sin(angle) / 10, 0)


def known_curve(name, formula, at, rate, T, place, g=0):
    rows.append([name, 'curve', *formula, at, rate, -g, T, 'right', *place, ''])


def swing(s0, v0, T, slopes, walls=()):
    """Constant acceleration `slopes(side of 0)` along s, elastic walls."""
    s, v, left = mpf(s0), mpf(v0), mpf(T)
    side = 1 if s > 0 else -1
    while True:
        a = slopes(side)
        ends = ([mpf(0)] if slopes(1) != slopes(-1) else []) + [mpf(w) for w in walls]
        best = None
        for e in ends:
            d = v * v - 2 * a * (s - e)
            if d < 0:
                continue
            for root in ((-v + mp.sqrt(d)) / a, (-v - mp.sqrt(d)) / a):
                if root > mpf(10) ** -20 and (best is None or root < best[0]):
                    best = (root, e)
        if best is None or best[0] >= left:
            return s + v * left + a * left * left / 2
        t, e = best
        left -= t
        s, v = e, v + a * t
        if e == 0 and slopes(1) != slopes(-1):
            side = 1 if v > 0 else -1
        else:
            v = -v


G = mpf('9.81')
# the circle told otherwise: |r_phi| runs away, the motion does not
known_curve('circle by an exponential', ['0.1*cos(exp(phi))', '0.1*sin(exp(phi))', '0'], 0, 2, 3, on_circle(7))
known_curve('circle by 1/phi', ['0.1*cos(1/phi)', '0.1*sin(1/phi)', '0'], 1, -1, 30, on_circle(31))
known_curve('circle by asin, to just before its end', ['0.1*cos(asin(phi))', '0.1*sin(asin(phi))', '0'], 0, 1, 1.5707, on_circle(mpf('1.5707')))
known_curve('circle by acos and root', ['0.1*phi', '0.1*sqrt(1 - phi^2)', '0'], 0, 1, 1.57, at_place(mp.sin(mpf('1.57')) / 10, mp.cos(mpf('1.57')) / 10, 0))
known_curve('circle by a root of phi', ['0.1*cos(sqrt(phi))', '0.1*sin(sqrt(phi))', '0'], 1, -1, 1.99, on_circle(mpf(1) - mpf('1.99') / 2))
stopped('line by asin of tanh', ['0.1*atan(sinh(phi))', '0.1*asin(tanh(phi))', '0'], 0, 1, 1.5, 'left what was examined')
known_curve('circle by a quotient', ['0.1*(1 - phi^2)/(1 + phi^2)', '0.2*phi/(1 + phi^2)', '0'], 0, 1, 1.5, on_circle(3))
# what is nothing after all
right('sine by tan and cos', [x, '0.1*tan(phi)*cos(phi)', '0'], 0, 1.5, 2, [(INF, [x, 'sin(phi)/10', '0'])])
stopped('square by its logarithm', [x, '0.1*exp(log(phi^2))', '0'], -1, 1, 2, 'spike at phi = 0: log(phi^2)', ['0', '0', '0'])
right('two roots of phi', [x, '0.1*sqrt(phi)*sqrt(phi)', '0'], 1, -1, 0.9, [(INF, [x, 'phi/10', '0'])])
right('phi to the nothing', [x, '0.1*phi^0', '0'], -1, 1, 2, [(INF, [x, '1/Integer(10)', '0'])])
right('huge times tiny', [x, '0.1*sin(phi*1e-300*1e300)', '0'], -1, 1, 2, [(INF, [x, 'sin(phi)/10', '0'])])
right('sign squared', [x, '0.1*sign(phi)^2', '0'], -1, 2, 1.2, [(INF, [x, '1/Integer(10)', '0'])])
# kinks by other words
refused('root of 1 - cos', [x, '0.1*sqrt(1 - cos(phi))', '0'], -1, 1.5, 2, 'the formula loses its digits there')
refused('acos that touches', [x, '0.1*acos(1 - phi^2)', '0'], -1, 1.5, 1.2, 'the formula loses its digits there')
right('abs of a sawtooth', [x, '0.05*abs(atan2(sin(phi), cos(phi)))', '0'], 0.5, 3, 2, [(PI, [x, 'phi/20', '0']), (2 * PI, [x, '(2*pi - phi)/20', '0']), (INF, [x, '(phi - 2*pi)/20', '0'])])
right('half the angle of atan2', [x, '0.1*cos(atan2(sin(phi), cos(phi))/2)', '0'], 0.5, 3, 2, [(PI, [x, 'cos(phi/2)/10', '0']), (3 * PI, [x, '-cos(phi/2)/10', '0']), (INF, [x, 'cos(phi/2)/10', '0'])])
right('a bend by a sign', [x, '0.1*sign(phi)*phi^2', '0'], -1, 2, 1.2, both([x, '-phi**2/10', '0'], [x, 'phi**2/10', '0']))
refused('a corner rounded by 1e-9', [x, '0.1*sqrt(phi^2 + 1e-18)', '0'], -1, 1, 1.5, 'too many sub-steps')
right('a step of tanh, 1e-9 wide', [x, '0.05*tanh(1e9*phi)', '0'], -1, 1, 1.7, [(INF, [x, 'tanh(10**9*phi)/20', '0'])], marks=[mpf(k) * mpf(10) ** e for e in range(-11, -1) for k in (-5, -2, -1, 1, 2, 5)] + [0])
NARROW = [mpf(k) * mpf(10) ** e for e in range(-9, -1) for k in (-5, -2, -1, 1, 2, 5)] + [0]
right('a step of a micrometre within one', [x, '1e-6*tanh(1e6*phi)', '0'], -1, 1, 1.7, [(INF, [x, 'tanh(10**6*phi)/10**6', '0'])], marks=NARROW)
right('a bump of a micrometre', [x, '1e-6*exp(-(1e6*phi)^2)', '0'], -1, 1, 1.7, [(INF, [x, 'exp(-10**12*phi**2)/10**6', '0'])], marks=NARROW)
right('a hurry of a micrometre', ['phi/10 + 1e-6*tanh(1e6*phi)', '0', '0'], -1, 1, 1.7, [(INF, ['phi/10 + tanh(10**6*phi)/10**6', '0', '0'])], marks=NARROW)
right('a needle in each turn', ['0.1*cos(phi)', '0.1*sin(phi)', '0.01/(1 + 1e8*sin(phi)^2)'], -1, 1, 1.5, [(INF, ['cos(phi)/10', 'sin(phi)/10', '1/(1 + 10**8*sin(phi)**2)/100'])], marks=NARROW)
stopped('kinks that pile up', [x, '0.1*phi*abs(sin(1/phi))', '0'], 1, -1, 3, 'left what was examined')
right('waves that pile up', [x, '0.1*phi^2*sin(1/phi)', '0'], 1, -1, 0.95)
# to and fro
a = G * mpf('0.05') / mp.sqrt(mpf('0.1') ** 2 + mpf('0.05') ** 2)
unit = mp.sqrt(mpf('0.1') ** 2 + mpf('0.05') ** 2)
s = swing(-unit, unit, 5, lambda side: -side * a)
known_curve('to and fro in a valley', [x, '0.05*abs(phi)', '0'], -1, 1, 5, at_place(s / unit / 10, abs(s) / unit / 20, 0), g=9.81)
s = swing(0, -2 * unit, 3, lambda side: -a, (-unit, unit))
known_curve('to and fro on a folded slope', ['0.1*cos(phi)', '0.05*cos(phi)', '0'], PI / 2, 2, 3, at_place(s / unit / 10, s / unit / 20, 0), g=9.81)
l4 = mpf('0.2')
w, s0, v0 = mp.sqrt(G / l4), l4 * mp.sin(mpf('1.5')), -l4 * mp.cos(mpf('1.5')) / 2 * mpf('0.1')
s = s0 * mp.cos(w * 10) + v0 / w * mp.sin(w * 10)
p = 2 * mp.asin(s / l4)
known_curve('the tautochrone to just before its cusps', ['0.05*(phi + sin(phi))', '0.05*(1 - cos(phi))', '0'], 3, -0.1, 10, at_place((p + mp.sin(p)) / 20, (1 - mp.cos(p)) / 20, 0), g=9.81)
k, w = mpf('0.999'), mp.sqrt(G / mpf('0.1'))
sn = mp.ellipfun('sn', w * 3, m=k * k)
p = 2 * mp.asin(k * sn)
known_curve('a pendulum to just before its top', ['0.1*sin(phi)', '-0.1*cos(phi)', '0'], 0, mp.nstr(2 * w * k, 17), 3, at_place(mp.sin(p) / 10, -mp.cos(p) / 10, 0), g=9.81)
# scales
right('phi in thousands of kilometres', ['1e6*phi', '0.1*sin(1e7*phi)', '0'], 0, 3e-7, 2, [(INF, ['10**6*phi', 'sin(10**7*phi)/10', '0'])])
right('a double exponential', [x, '1e-3*exp(exp(phi))', '0'], 0, 1, 20, [(INF, [x, 'exp(exp(phi))/1000', '0'])])
known_curve('phi a million', ['0.1*cos(phi)', '0.1*sin(phi)', '0'], 1e6, 1, 2, on_circle(mpf(1000002)))
known_curve('phi a thousand million', ['0.1*cos(phi)', '0.1*sin(phi)', '0'], 1e9, 1, 2, on_circle(mpf(1000000002)))
refused('digits that cancel', [x, '5e10*(1 - cos(1e-6*phi))', '0'], -1, 1, 2, 'the formula loses its digits')
refused('a sum with 1e12', [x, '0.1*((sin(phi) + 1e12) - 1e12)', '0'], -1, 1, 2, 'the formula loses its digits')
# surfaces
stopped('plane by exponentials, past the origin', ['0.1*exp(u)*cos(v)', '0.1*exp(u)*sin(v)', '0'], '0,0', '-1,0.01', 2, 'degenerates', kind='surface')
known('plane by exponentials', ['0.1*exp(u)*cos(v)', '0.1*exp(u)*sin(v)', '0'], '0,0', '-1,0.1', 2, ['-0.1', '0.02', '0'])
known('plane by sinh', ['0.1*sinh(3*u)', '0.1*(v + u^2)', '0'], '-1,0', '0.2,0.5', 2, at_place(-mp.sinh(3) / 10 + 2 * mpf('0.06') * mp.cosh(3), mpf('0.1') + 2 * (mpf('0.05') - mpf('0.04')), 0))
stopped('plane by cubes', ['u^3/10', 'v/10', '0'], '-1,0', '0.5,0.2', 3, 'degenerates', ['0', mp.nstr(mpf(2) / 150, 20), '0'], kind='surface')
q = mp.sqrt(2)
z = mp.mpc(mpf('0.1') * q, 0) + mpf('1.2') * mp.mpc(-mpf('0.05') * q, mpf('0.1'))
rho, u = abs(z) / q, mp.arg(z) * q
known('cone, unfolded', ['0.1*v*cos(u)', '0.1*v*sin(u)', '0.1*v'], '0,1', '1,-0.5', 1.2, at_place(rho * mp.cos(u), rho * mp.sin(u), rho))
e = solve([(INF, ['cos(phi)/10', 'sin(phi)/20', '0'])], 0, 1, 4)
known('elliptic cylinder, unfolded', ['0.1*cos(u)', '0.05*sin(u)', 'v/10'], '0,0', '1,0.3', 4, at_place(e[0], e[1], mpf('0.12')))


def trumpet(v0, du, dv, T):  # rho = exp(-v)/10, z = v/10; Clairaut
    rho = lambda v: mp.exp(-v) / 10
    g = lambda v: mpf('0.01') * (1 + mp.exp(-2 * v))
    L, E2 = rho(v0) ** 2 * du, rho(v0) ** 2 * du ** 2 + g(v0) * dv ** 2
    vt = lambda v: mp.sqrt((E2 - L * L / rho(v) ** 2) / g(v))
    v1 = mp.findroot(lambda b: mp.quad(lambda v: 1 / vt(v), mp.linspace(v0, b, 9)) - T, v0 + dv * T)
    u1 = mp.quad(lambda v: L / rho(v) ** 2 / vt(v), mp.linspace(v0, v1, 9))
    return at_place(rho(v1) * mp.cos(u1), rho(v1) * mp.sin(u1), v1 / 10)


known('trumpet', ['0.1*exp(-v)*cos(u)', '0.1*exp(-v)*sin(u)', '0.1*v'], '0,0', '0.1,0.5', 2, trumpet(mpf(0), mpf('0.1'), mpf('0.5'), 2))
known('sphere of a micrometre', ['1e-6*cos(u)*cos(v)', '1e-6*sin(v)', '1e-6*sin(u)*cos(v)'], '0,0', '0.3,0.4', 2, at_place(mpf('1e-6') * mp.cos(1), mpf('0.8e-6') * mp.sin(1), mpf('0.6e-6') * mp.sin(1)))
known('sphere of a kilometre', ['1e3*cos(u)*cos(v)', '1e3*sin(v)', '1e3*sin(u)*cos(v)'], '0,0', '0.003,0.004', 2, at_place(1000 * mp.cos(mpf('0.01')), 800 * mp.sin(mpf('0.01')), 600 * mp.sin(mpf('0.01'))))
known('pyramid of four planes', ['u/10', 'v/10', '0.1*abs(u)'], '-1,0.2', '1,0', 2, ['0.1', '0.02', '0.1'])
refused('a step across a surface', ['u/10', '0.05*tanh(1e9*u)', 'v/10'], '-1.00037,0', '1,0.2', 1.7, 'too many sub-steps', kind='surface')
stopped('a ridge of a needle', ['u/10', '0.01*exp(-(1e5*u)^2)', 'v/10'], '-1.00037,0', '1,0.2', 1.7, 'the surface was so steep', kind='surface')

print('name\tkind\tx\ty\tz\tat\trate\tgravity_y\tseconds\tverdict\tx_m\ty_m\tz_m\twords')
for row in rows:
    print('\t'.join(str(c) for c in row))
