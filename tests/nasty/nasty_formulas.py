#!/usr/bin/env python3
"""Nasty formulas: where a free mass is after some seconds, to 30 digits, or which words end it.

    python3 tests/nasty/nasty_formulas.py > tests/nasty/nasty_formulas.tsv        (mpmath, SymPy; two minutes)

Independent of the program: every curve stands here once more as pieces that are smooth by hand, and the motion is arc length (dt = ds/v, with
v^2 = v0^2 - 2 g (y - y0) under gravity), integrated and inverted by mpmath. Creased planes are unfolded, on paper.
Columns: name, kind, x, y, z, at, rate, gravity_y, seconds, verdict (right | stopped | refused), x_m, y_m, z_m, words. For `stopped` the
place is given where it is known; `words` must stand in the sentence."""
import sys
import mpmath as mp
import sympy as sp
mp.mp.dps = 40
P = sp.Symbol('phi')
INF = 1e9


def piece_functions(texts):
    e = [sp.sympify(t, {'phi': P, 'e': sp.E}) for t in texts]
    return sp.lambdify(P, e, 'mpmath'), sp.lambdify(P, [sp.diff(c, P) for c in e], 'mpmath')


def solve(pieces, at, rate, T, g=0, marks=()):
    """phi after T on pieces [(upper bound, x, y, z)], moving one way."""
    fs = [(mp.mpf(hi), *piece_functions(t)) for hi, t in pieces]
    at, rate, T = mp.mpf(at), mp.mpf(rate), mp.mpf(T)

    def of(phi, side):
        for hi, r, d in fs:
            if phi < hi or (phi == hi and side < 0):
                return r, d
        return fs[-1][1:]
    up = 1 if rate > 0 else -1
    r0, d0 = of(at, up)
    speed0 = mp.sqrt(sum(c * c for c in d0(at))) * abs(rate)
    y0 = r0(at)[1]

    def time(a, b):  # within one piece
        r, d = of((a + b) / 2, 1)
        f = lambda p: mp.sqrt(sum(c * c for c in d(p))) / mp.sqrt(speed0 ** 2 - 2 * mp.mpf(g) * (r(p)[1] - y0))
        return abs(mp.quad(f, [a, (a + b) / 2, b]))
    cuts = sorted([hi for hi, *_ in fs if hi < INF] + [mp.mpf(m) for m in marks], reverse=up < 0)
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
        if abs(miss) < mp.mpf(10) ** -28:
            break
        if miss * 1 > 0:
            hi = phi
        else:
            lo = phi
        slope = mp.sqrt(sum(c * c for c in d(phi))) / mp.sqrt(speed0 ** 2 - 2 * mp.mpf(g) * (r(phi)[1] - y0))
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

print('name\tkind\tx\ty\tz\tat\trate\tgravity_y\tseconds\tverdict\tx_m\ty_m\tz_m\twords')
for row in rows:
    print('\t'.join(str(c) for c in row))
