"""Hull programs to compare the project's speed with: Qhull through scipy, and CGAL through a short C++ program."""

import os
import shlex
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

from modern.bench.timing import Measured

# The compilers that are tried in this order if the environment variable CXX names none.
COMPILERS = ("c++", "g++", "clang++")

# A program that runs ``convex_hull_3`` with exact predicates twice, because the first run fills the caches.  For each
# run it prints the processor seconds and the number of vertices.
CGAL = """
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <ctime>
#include <iostream>
#include <vector>
typedef CGAL::Exact_predicates_inexact_constructions_kernel::Point_3 Point;
int main() {
  std::vector<Point> points;
  for (double x, y, z; std::cin >> x >> y >> z;) points.push_back(Point(x, y, z));
  for (int run = 0; run < 2; run++) {
    CGAL::Surface_mesh<Point> hull;
    std::clock_t start = std::clock();
    CGAL::convex_hull_3(points.begin(), points.end(), hull);
    double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
    std::cout << seconds << ' ' << hull.number_of_vertices() << std::endl;
  }
}
"""

_LIBRARIES = (("-lgmp", "-lmpfr"), ("-lgmp",), ())
_PATIENCE = 300

Work = Callable[[], object]
# A peer: a function that prepares points of shape (n, 3) and returns the function that computes their hull.
Peer = Callable[[Any], Work]


class Missing(Exception):
    """Raised if a program to compare with is not installed.  The message gives the reason."""


def installed(folder: Path) -> tuple[dict[str, Peer], list[str]]:
    """Return the installed peers by name, and a line for each missing one.  Programs are compiled in ``folder``."""
    peers: dict[str, Peer] = {}
    remarks = []
    for name, peer in (("Qhull", qhull), ("CGAL", lambda: cgal(folder))):
        try:
            peers[name] = peer()
        except Missing as reason:
            remarks.append(f"{name} is omitted: {reason}")
    return peers, remarks


def qhull() -> Peer:
    """Return the peer that computes hulls by Qhull.  Raise Missing if scipy is not installed."""
    try:
        from scipy.spatial import ConvexHull
    except ImportError:
        raise Missing("scipy is not installed") from None

    def peer(points: Any) -> Work:
        doubles = points.astype("float64")
        return lambda: ConvexHull(doubles)

    return peer


def cgal(folder: Path) -> Peer:
    """Return the peer that computes hulls by CGAL in a new process.  Raise Missing if it cannot be compiled."""
    command_of_cxx = shlex.split(os.environ.get("CXX", ""))
    command = command_of_cxx or next(([name] for name in COMPILERS if shutil.which(name)), [])
    if not command or not shutil.which(command[0]):
        raise Missing(f"expected a C++ compiler ({', '.join(COMPILERS)}, or the value of CXX), found none")
    source, program = folder / "hull.cpp", folder / "hull"
    source.write_text(CGAL, encoding="ascii")
    for libraries in _LIBRARIES:
        compiled = [*command, "-O2", "-DNDEBUG", "-w", "-o", str(program), str(source), *libraries]
        try:
            process = subprocess.run(compiled, capture_output=True, text=True, timeout=_PATIENCE)
        except (OSError, subprocess.TimeoutExpired) as error:
            raise Missing(f"{command[0]}: {error}") from None
        if not process.returncode:
            break
    else:
        error_line = next((line for line in process.stderr.splitlines() if "rror" in line), "no reason given")
        raise Missing(f"{command[0]} cannot compile a program with CGAL's headers: {error_line.strip()}")

    def peer(points: Any) -> Work:
        text = "".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in points.tolist())

        def work() -> Measured:
            run = subprocess.run([program], input=text, capture_output=True, text=True, check=True)
            return Measured(run.stdout.splitlines()[-1].split()[0])

        return work

    return peer
