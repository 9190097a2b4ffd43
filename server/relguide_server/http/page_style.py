"""How the pages that describe the API look."""

from html import escape


def prose(text: str) -> str:
    """Markdown's code marks as HTML's."""
    parts = escape(text).split("`")
    return "".join(f"<code>{part}</code>" if k % 2 else part for k, part in enumerate(parts))


STYLE = (
    "body{background:#0b0d10;color:#e5dfd6;font:16px/1.5 sans-serif}main{max-width:62em;"
    "margin:2em auto;padding:0 1em}a{color:#17e9f2}code{color:#ffd479}table{border-collapse:"
    "collapse;width:100%}td{border-top:1px solid #333;padding:.3em .8em .3em 0;vertical-align:top}"
    "caption{text-align:left;padding:.5em 0}h2{margin-top:2em}"
)
