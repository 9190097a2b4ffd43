"""The network of turning leaders: which template may be the fastest behind a leader who turns once.

As `template_network`, of situations of eleven numbers (`kernels.networks.turning_leader`).
"""

from importlib.resources import files
from pathlib import Path

from relguide.kernels.networks.turn_features import FEATURES, turn_feature_rows
from relguide.kernels.networks.turn_solutions import label_turn_templates
from relguide.kernels.networks.turn_templates import GUESS, TEMPLATES
from relguide.learn.boundary.template_network import (
    Rules,
    TemplateKind,
    TemplateNetwork,
    load_network_of,
)
from relguide.learn.boundary.turn_labels import TurnBox, advance_turning

SHIPPED_TURNS = Path(str(files("relguide.learn.boundary") / "turns.safetensors"))
"""The weights that come with the program."""
TURNING = TemplateKind(
    file="relguide turn network 1",
    method="turns",
    templates=TEMPLATES,
    features=FEATURES,
    guess=GUESS,
    box=TurnBox,
    write_features=turn_feature_rows,
    write_targets=label_turn_templates,
    advance=advance_turning,
    # a template takes a hundredth of a search, so all may be solved; of what is answered besides
    # with a doubt of 0.3, one in ten, 2 % are late
    rules=Rules(least_share=0.001, coverage=0.99, most=100, doubt=0.1, evened=1.8),
)
"""Leaders who turn once, to the left."""


def load_turn_network(file: Path = SHIPPED_TURNS) -> TemplateNetwork[TurnBox]:
    """Read a network of `TURNING`.

    Raises:
        ValueError: if the file holds no such network, or one that does not fit this version.
    """
    return load_network_of(TURNING, file)
