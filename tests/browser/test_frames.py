"""What a frame costs the browser: it moves what is drawn, and lays out nothing."""

from playwright.sync_api import Page, expect

from tests.browser.service import Service
from tests.browser.trace import measured, turn

SECONDS = 5
OTHER = 5
"""Layouts that are no picture's: a line of the log, a button that changes."""


def test_frames_between_pictures_lay_out_nothing(page: Page, sky: Service) -> None:
    """In a turn at the shortest range, where all on the glass moves with every frame."""
    page.goto(f"{sky.url}/?engaged")
    expect(page.locator(".connection")).to_have_text("Live")
    page.get_by_role("button", name="×1", exact=True).click()
    turn(page)
    cost = measured(page, SECONDS)
    assert cost.carried > cost.drawn
    assert cost.layouts <= cost.drawn + OTHER
