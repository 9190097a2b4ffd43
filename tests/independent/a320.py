"""JSBSim's A320 in the place of ours: another's physics, flown by our autopilot and guidance.

    guidance → autopilot (20 Hz): a roll rate → normal law (120 Hz): aileron, rudder → JSBSim
                                                altitude and airspeed are held beside it

JSBSim reads the aircraft from its own package; nothing of it is copied here. It flies over the
equator, where the earth's turning bends no path, in air that stands still or is turbulent; the wind
is added to its velocity over the ground.
"""

from math import cos, hypot, sin

import jsbsim
import numpy as np

from relguide.flying.fleet import Fleet
from relguide.flying.world import Guided, World
from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.flight.autopilot import aileron, commanded_bank
from relguide.kernels.flight.energy import least_tas, load_square
from relguide.kernels.flight.flight_records import Body, Control, Drift, Limits, limits_at, store
from relguide.kernels.flight.second import RECORDED
from relguide.planning.wind import Wind
from relguide.units import FT, G0, Metre, MetrePerSecond, Second

FRAMES = 120
"""Of JSBSim in a second."""
ROLL_KP, ROLL_KI = 0.69, 1.06
"""Its roll mode (0.65 s, 1.9 rad/s for full aileron) becomes the 0.5 s of our data."""
RUDDER_KP, RUDDER_KI = 5.0, 5.0
"""Sideslip to rudder: none is left."""
CLIMB_RATE, MOST_CLIMB, LIFT_RATE = 0.15, 5.0, 0.5
"""Altitude to climb rate, at most so much, and climb rate to acceleration [1/s, m/s, 1/s]."""
PITCH_KP, PITCH_KI, PITCH_KQ = 0.1, 0.6, 1.0
"""Load factor to elevator, and what damps the pitch."""
THRUST_K = 0.2
"""Throttle for a metre a second of airspeed [s/m]."""
QUICK = 0.5
"""The throttle stays above it and speed brakes do the rest: from idle these engines take 7 s."""
MODERATE = {"windspeed_at_20ft_AGL-fps": 50.0, "severity": 4.0}
"""Moderate turbulence of MIL-F-8785C, as JSBSim names it …"""
MODERATE_GUSTS: MetrePerSecond = 2.0
"""… and σ of its gusts at FL246, over ten minutes of them."""
MIL = 3.0

# JSBSim says which version it is, and all that it has read
ERRORS = jsbsim.DefaultLogger()
ERRORS.set_min_level(jsbsim.LogLevel.ERROR)
jsbsim.set_logger(ERRORS)


class A320:
    """One of them in flight."""

    def __init__(self, body: Body, altitude: Metre, seed: int | None = None) -> None:
        """Trimmed in level flight with its gear up; in turbulence if a seed is given."""
        self.body, self.altitude, self.wind = body, altitude, Drift(0.0, 0.0)
        self.fdm = fdm = jsbsim.FGFDMExec(None)
        fdm.set_debug_level(0)
        fdm.load_model("A320")
        fdm.set_dt(1.0 / FRAMES)
        fdm["ic/h-sl-ft"], fdm["ic/vt-fps"] = altitude / FT, body.tas / FT
        fdm["ic/psi-true-rad"] = body.heading
        fdm["gear/gear-cmd-norm"] = fdm["gear/gear-pos-norm"] = 0.0
        fdm.run_ic()
        fdm["propulsion/set-running"] = -1
        fdm.do_trim(1)
        if seed is not None:
            fdm["atmosphere/randomseed"], fdm["atmosphere/turb-type"] = seed + 1.0, MIL
            for name, value in MODERATE.items():
                fdm[f"atmosphere/turbulence/milspec/{name}"] = value
        self.roll = self.slip = self.lift = 0.0
        self.thrust = fdm["fcs/throttle-cmd-norm[0]"] + THRUST_K * body.tas

    def fly(self, control: Control, limits: Limits, wind: Wind, dt: Second) -> Body:
        """A step of the autopilot on; `wind` is then what air data and ground track give.

        The heading is the way it moves through the air as the wind alone moves that.
        """
        fdm, frames, before = self.fdm, round(dt * FRAMES), self.body
        bank, integral = commanded_bank(before, control, limits, dt)
        asked = aileron(bank, before, limits)
        least = least_tas(limits, load_square(before.bank))
        tas = min(max(control.tas, least), limits.max_tas)
        x, y = before.x, before.y
        for _ in range(frames):
            self._steer(asked, tas, limits.speed_time)
            fdm.run()
            x += (fdm["velocities/v-east-fps"] * FT + wind.east) / FRAMES
            y += (fdm["velocities/v-north-fps"] * FT + wind.north) / FRAMES
        turned = wrap_signed(fdm["flight-path/psi-gt-rad"] - before.heading)
        heading, v = before.heading + turned, fdm["velocities/vt-fps"] * FT
        bank, roll_rate = fdm["attitude/phi-rad"], fdm["velocities/phidot-rad_sec"]
        slower = hypot(fdm["velocities/v-east-fps"], fdm["velocities/v-north-fps"]) * FT - v
        self.wind = Drift(wind.east + slower * sin(heading), wind.north + slower * cos(heading))
        self.body = Body(x, y, heading, bank, roll_rate, v, integral)
        return self.body

    def _steer(self, roll_rate: float, tas: MetrePerSecond, speed_time: Second) -> None:
        """Set all that moves for a frame."""
        fdm, dt = self.fdm, 1.0 / FRAMES
        error = roll_rate - fdm["velocities/phidot-rad_sec"]
        self.roll += ROLL_KI * error * dt
        fdm["fcs/aileron-cmd-norm"] = ROLL_KP * error + self.roll
        slip = fdm["aero/beta-rad"]
        self.slip += RUDDER_KI * slip * dt
        fdm["fcs/rudder-cmd-norm"] = -RUDDER_KP * slip - self.slip
        low = self.altitude - fdm["position/h-sl-ft"] * FT
        climb = min(max(CLIMB_RATE * low, -MOST_CLIMB), MOST_CLIMB)
        lift = 1.0 + LIFT_RATE * (climb - fdm["velocities/h-dot-fps"] * FT) / G0
        short = lift / cos(fdm["attitude/phi-rad"]) - fdm["accelerations/Nz"]
        self.lift += PITCH_KI * short * dt
        damping = PITCH_KQ * fdm["velocities/q-rad_sec"]
        fdm["fcs/elevator-cmd-norm"] = damping - PITCH_KP * short - self.lift
        v = fdm["velocities/vt-fps"] * FT
        free, short = self.thrust - THRUST_K * v, tas - v
        effort = min(max(free, QUICK - 1.0), 1.0)
        if effort == free or (effort - free) * short > 0.0:  # nothing is wound up at the stops
            self.thrust += THRUST_K / speed_time * short * dt
        for engine in (0, 1):
            fdm[f"fcs/throttle-cmd-norm[{engine}]"] = max(effort, QUICK)
        fdm["fcs/speedbrake-cmd-norm"] = max(QUICK - effort, 0.0)


class A320Fleet(Fleet):
    """The aircraft of a world in flight; those that are guided are JSBSim's."""

    kind: type[A320] = A320

    def __init__(self, world: World, step: Second, seed: int = 0) -> None:
        """All aircraft where they begin; where there are gusts, JSBSim makes its own."""
        super().__init__(world, step, seed)
        turbulence = seed if world.air.gusts > 0.0 else None
        self.flown = {
            i: self.kind(self.body(i), aircraft.altitude, turbulence)
            for i, aircraft in enumerate(world.aircraft)
            if isinstance(aircraft.pilot, Guided)
        }
        self.pilots[list(self.flown)] = RECORDED

    def fly_second(self, t: Second) -> None:
        """All aircraft, one second on: what JSBSim flies is given as if it were recorded."""
        winds = {i: np.tile(self.winds[i, -1], (self.steps + 1, 1)) for i in self.flown}
        for i, a320 in self.flown.items():
            can, control = limits_at(self.limits, i), Control(*self.controls[i].tolist())
            wind = self._wind_at(i, a320.altitude, t)
            store(self.trace[i], 0, self.body(i))
            for k in range(1, self.steps + 1):
                store(self.trace[i], k, a320.fly(control, can, wind, self.step))
                self.altitudes[i, k] = a320.fdm["position/h-sl-ft"] * FT
                winds[i][k] = a320.wind
        super().fly_second(t)
        for i, met in winds.items():
            self.winds[i] = met
