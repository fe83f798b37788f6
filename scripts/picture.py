"""What the scripts that draw pictures for the docs share."""
import html
import sys

FONT = "system-ui, Segoe UI, Helvetica, Arial, sans-serif"


def head(width, height, title):
    return [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}"'
            f' height="{height}" font-family="{FONT}">',
            f"<title>{html.escape(title)}</title>",
            f'<rect width="{width}" height="{height}" fill="white"/>']


def text_at(x, y, words, size=13, anchor="start", colour="#222", weight="normal"):
    return (f'<text x="{x}" y="{y}" font-size="{size}" text-anchor="{anchor}" fill="{colour}"'
            f' font-weight="{weight}">{html.escape(words)}</text>')


def write(path, picture, check):
    """Writes the picture; `check`: ends the program if that would change it."""
    if not check:
        path.write_text(picture)
    elif not path.exists() or path.read_text() != picture:
        sys.exit(f"docs/{path.name} is out of date: run {sys.argv[0]}")
