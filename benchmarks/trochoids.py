"""OMPL's paths in wind, set our problem: a slot at rest, and air that blows at −V_L past it."""

from math import pi

from ompl import base as ob  # type: ignore[import-untyped]

from benchmarks.cases import Case


class Trochoids:
    """One case as OMPL takes it."""

    def __init__(self, case: Case) -> None:
        """Set it up, which is not timed."""
        frame = case.frame
        self._unit = case.unit
        self._space = ob.TrochoidStateSpace(1.0, frame.alpha, pi)
        bounds = ob.RealVectorBounds(2)
        bounds.setLow(-1e6)
        bounds.setHigh(1e6)
        self._space.setBounds(bounds)
        self._start, self._goal = self._space.allocState(), self._space.allocState()
        self._start.setX(frame.x)
        self._start.setY(frame.y)
        self._start.setYaw(frame.h if frame.h <= pi else frame.h - 2.0 * pi)
        self._goal.setX(0.0)
        self._goal.setY(0.0)
        self._goal.setYaw(0.0)

    def time(self) -> float:
        """Its least time to the slot [s]."""
        return float(self._space.distance(self._start, self._goal)) * self._unit

    def arrives(self) -> bool:
        """Does its path end in the slot? Looked at just before its end, which it forces there."""
        last = self._space.allocState()
        self._space.interpolate(self._start, self._goal, 1.0 - 1e-7, last)
        # 1e-7 of the longest path here, 300 R
        return bool(abs(last.getX()) < 1e-4 and abs(last.getY()) < 1e-4)
