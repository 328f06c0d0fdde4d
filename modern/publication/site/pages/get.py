"""The list of downloads with their sizes and licences."""

from modern.publication.site.downloads import FOLDER, downloads
from modern.publication.site.made import Made, Part, one_of
from modern.publication.site.markup import HERE, escape, table, text


def make(argument: str) -> Made:
    """Return the table of ``files``."""
    one_of(argument, ("files",))
    rows = []
    for item in downloads():
        size = sum(map(len, item.files.values()))
        content = f"{len(item.files)} files, {_size(size)}" if item.packed else _size(size)
        file_link = text("a", item.name, href=f"{HERE}{FOLDER}/{item.name}", download=True)
        rows.append((file_link, escape(item.title), content, escape(item.licence)))
    return Made((Part(html=table(("file", "contents", "size unpacked", "licence"), rows, "Downloads")),))


def _size(count: int) -> str:
    return f"{count / 1e6:.1f} MB" if count >= 1e5 else f"{count / 1e3:.0f} kB"
