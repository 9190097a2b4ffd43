"""A plugin of pytest's: the examples of every run, and none made smaller when a test fails."""

from hypothesis import HealthCheck, Phase, settings

settings.register_profile(
    "hasty",
    derandomize=True,
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow],
    phases=[Phase.explicit, Phase.generate],
)
