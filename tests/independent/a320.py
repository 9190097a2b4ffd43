"""JSBSim's A320 in the place of ours: its own physics, flown by our autopilot and our guidance.

    guidance → autopilot (20 Hz): a roll rate → normal law (120 Hz): aileron, rudder → JSBSim
                                               altitude and airspeed are held beside it

JSBSim reads the aircraft from its own package; nothing of it is copied here. It flies in calm air,
or in its own turbulence, over the equator, where the earth's turning bends no path; the wind is
added to its velocity over the ground.
"""

from math import cos, pi

import jsbsim

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.flight.autopilot import aileron
from relguide.kernels.flight.energy import least_tas, load_square
from relguide.kernels.flight.flight_records import Body, Control, Drift, Limits, limits_at, store
from relguide.flying.fleet import Fleet
from relguide.kernels.flight.second import RECORDED
from relguide.flying.world import Guided, World
from relguide.units import FT, G0, Metre, Second

FRAMES = 120
"""Of JSBSim in a second."""
ROLL_KP, ROLL_KI = 0.69, 1.06
"""Its roll mode (0.65 s, 1.9 rad/s a unit of aileron) becomes the 0.5 s that our data have."""
RUDDER_KP, RUDDER_KI = 5.0, 5.0
"""Takes the sideslip away."""
CLIMB_RATE, LIFT_RATE = 0.15, 0.5
"""Altitude to climb rate, and climb rate to vertical acceleration [1/s]."""
PITCH_KP, PITCH_KI, PITCH_KQ = 0.1, 0.6, 1.0
"""Load factor to elevator, and what damps the pitch [1, 1/s, s]."""
THRUST_K = 0.2
"""Throttle for a metre a second of airspeed; below 0 the speed brakes come out [s/m]."""
QUICK = 0.5
"""The throttle stays above it: from idle the engines take 7 s. The speed brakes do the rest."""
MIL, TURBULENCE = 3, {"windspeed_at_20ft_AGL-fps": 50.0, "severity": 4.0}
"""JSBSim's turbulence of MIL-F-8785C, moderate."""


class A320:
    """One of them in flight."""

    def __init__(self, body: Body, altitude: Metre, turbulence: int | None = None) -> None:
        """Trimmed in level flight, its gear up; with a seed, in moderate turbulence."""
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
        if turbulence is not None:
            fdm["simulation/randomseed"] = turbulence
            fdm["atmosphere/turb-type"] = MIL
            for name, value in TURBULENCE.items():
                fdm[f"atmosphere/turbulence/milspec/{name}"] = value
        self.body, self.altitude = body, altitude
        self.roll = self.slip = self.lift = 0.0
        self.thrust = fdm["fcs/throttle-cmd-norm[0]"] + THRUST_K * body.tas

    def fly(self, control: Control, limits: Limits, wind: Drift, dt: Second) -> Body:
        """A step of the autopilot on."""
        asked, integral = aileron(self.body, control, limits, dt)
        square = load_square(self.body.bank)
        tas = min(max(control.tas, least_tas(limits, square)), limits.max_tas)
        x, y, frames = self.body.x, self.body.y, round(dt * FRAMES)
        fdm, frame = self.fdm, dt / frames
        for _ in range(frames):
            self._steer(asked, tas, limits, frame)
            fdm.run()
            x += fdm["velocities/v-east-fps"] * FT * frame + wind.east * frame
            y += fdm["velocities/v-north-fps"] * FT * frame + wind.north * frame
        before = self.body.heading
        self.body = Body(
            x, y,
            before + wrap_signed(fdm["flight-path/psi-gt-rad"] - before),
            fdm["attitude/phi-rad"],
            fdm["velocities/phidot-rad_sec"],
            fdm["velocities/vt-fps"] * FT,
            integral,
        )  # fmt: skip
        return self.body

    def _steer(self, roll_rate: float, tas: float, limits: Limits, dt: Second) -> None:
        fdm = self.fdm
        error = roll_rate - fdm["velocities/phidot-rad_sec"]
        self.roll += ROLL_KI * error * dt
        fdm["fcs/aileron-cmd-norm"] = ROLL_KP * error + self.roll
        slip = fdm["aero/beta-rad"]
        self.slip += RUDDER_KI * slip * dt
        fdm["fcs/rudder-cmd-norm"] = -RUDDER_KP * slip - self.slip
        high = fdm["position/h-sl-ft"] * FT - self.altitude
        climb = min(max(-CLIMB_RATE * high, -5.0), 5.0) - fdm["velocities/h-dot-fps"] * FT
        wanted = (1.0 + LIFT_RATE * climb / G0) / cos(fdm["attitude/phi-rad"])
        short = wanted - fdm["accelerations/Nz"]
        self.lift += PITCH_KI * short * dt
        damping = PITCH_KQ * fdm["velocities/q-rad_sec"]
        fdm["fcs/elevator-cmd-norm"] = damping - PITCH_KP * short - self.lift
        v = fdm["velocities/vt-fps"] * FT
        self.thrust += THRUST_K / limits.speed_time * (tas - v) * dt
        effort = min(max(self.thrust - THRUST_K * v, QUICK - 1.0), 1.0)
        self.thrust = effort + THRUST_K * v  # nothing is wound up at the stops
        for engine in (0, 1):
            fdm[f"fcs/throttle-cmd-norm[{engine}]"] = max(effort, QUICK)
        fdm["fcs/speedbrake-cmd-norm"] = max(QUICK - effort, 0.0)


class A320Fleet(Fleet):
    """Aircraft of a world in flight: those that are guided are A320s of JSBSim."""

    def __init__(self, world: World, step: Second, seed: int = 0) -> None:
        """All aircraft where they begin."""
        super().__init__(world, step, seed)
        self.flown = {
            i: A320(self.body(i), aircraft.altitude, None)
            for i, aircraft in enumerate(world.aircraft)
            if isinstance(aircraft.pilot, Guided)
        }
        self.pilots[list(self.flown)] = RECORDED

    def fly_second(self, t: Second) -> None:
        """All aircraft, one second on: what JSBSim flies is given as if it were recorded."""
        for i, a320 in self.flown.items():
            can, control = limits_at(self.limits, i), Control(*self.controls[i].tolist())
            store(self.trace[i], 0, self.body(i))
            for k in range(self.steps):
                store(self.trace[i], k + 1, a320.fly(control, can, self.drift(i), self.step))
                self.altitudes[i, k + 1] = a320.fdm["position/h-sl-ft"] * FT
        super().fly_second(t)
