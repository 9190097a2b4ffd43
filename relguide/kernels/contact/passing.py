"""Which words may lead to a contact with d = d_min, and which on from it.

A contact is a least distance: d″ must not be negative there, neither before nor after. Who slides
along the circle turns toward the leader at k V_P/R, with a side s and h′ as in `contact`

    k = s h′,

and who turns toward it at w V_P/R has d″ in proportion to k − w. So where −1 < k < 1 the pursuer
turns away from the leader as it comes, and as it goes; where k < 0 it may not even be straight, and
where k < −1 there is no contact. A word has its first and last turn at full bank (w = ±1). One that
begins or ends with a straight is the limit of some that begin or end with a turn of either kind.

A set of words is a sum of 2 to the power of each word's number in `extremals`.
"""

from numba import njit

from relguide.kernels.base.records import Contact, Scene
from relguide.kernels.contact.contact import boundary_arc_rates, disc_on
from relguide.kernels.separation.clearance import piece_at

_BEGIN_LEFT, _BEGIN_RIGHT = 1 + 4 + 16, 2 + 8 + 32  # LSL, LSR, LRL; RSR, RSL, RLR
_END_LEFT, _END_RIGHT = 1 + 8 + 16, 2 + 4 + 32  # LSL, RSL, LRL; RSR, LSR, RLR
# contacts are flown a little outside d_min: a turn that breaks it by less than that may be flown
_SLACK = 0.03  # (2/3 of its cube, over the square of how fast d″ grows) [V_P/R]
_MOMENT = 1e-9  # a contact so soon before the leader goes on to its next piece is on that [R/V_P]


@njit(cache=True, nogil=True)
def words_onward(scene: Scene, bearing: float, side: float, t: float) -> int:
    """The words that may lead on from a contact at time t, on whatever piece the leader then is."""
    piece = piece_at(scene.leader, t + _MOMENT)
    return _turning(scene, Contact(piece, bearing, side), _BEGIN_LEFT, _BEGIN_RIGHT)


@njit(cache=True, nogil=True)
def words_toward(scene: Scene, contact: Contact) -> int:
    """The words that may lead to a contact.

    Just as the leader's piece begins, the one before it decides: so what that allows is among them.
    """
    words = _turning(scene, contact, _END_LEFT, _END_RIGHT)
    if contact.piece > 0:
        before = Contact(contact.piece - 1, contact.bearing, contact.side)
        words |= _turning(scene, before, _END_LEFT, _END_RIGHT)
    return words


@njit(cache=True, nogil=True)
def _turning(scene: Scene, contact: Contact, left: int, right: int) -> int:
    """Which of two sets of words are allowed at a contact, by the side to which they turn there."""
    _, rate = boundary_arc_rates(contact.bearing, disc_on(scene, contact.piece, contact.side))
    allowed, toward = 0, contact.side * rate
    for turn, words in ((1.0, left), (-1.0, right)):
        if turn * contact.side <= toward + _SLACK:
            allowed |= words
    return allowed
