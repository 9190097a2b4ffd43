"""Ten aircraft, each with a place of its own."""

from relguide.figures.ours.stream_of_ten import TEN, ten


def test_ten_that_begin_apart_on_both_sides() -> None:
    asked = ten()
    all_of_them = [asked.situation.pursuer, *(one.pursuer for one in asked.followers)]
    assert len(all_of_them) == TEN
    assert [one.y > 0.0 for one in all_of_them] == [False, True] * (TEN // 2)
    assert [one.ident for one in asked.followers] == [str(k) for k in range(2, TEN + 1)]
