#!/usr/bin/env python3
"""A first run of points by many ranks, without the meshing: one JSON line a case.

    scale.py [--dimension D] [--points N] [--ranks P...] [--design now|divided|read] [...]
    scale.py --check

The ranks stand in a grid, as the cuts of a k-d tree of uniform points place them. The run goes as
TiledMesher::first_run: the quadtree; bucket after bucket (horizons); the stars. In each step every
rank draws its calls; in each round every rank draws the messages to each neighbour, those who
receive them run calls, and the slowest rank decides when the round ends. A round is held if some
rank has something to say. Arrays have an entry for every rank; there are no classes of ranks.

What is drawn from is counted (scale_counts.json, made from `rounds_bench --steps`): calls and
messages of each horizon, and how they are spread over rounds, of one run on 16 ranks. Laws of calls
and of messages between neighbours are fitted to runs on up to 16 ranks; those of what lies outside
the points, and of how many rounds follow the last one counted, to runs on up to 256. --check
repeats the runs of the table on up to 1024 ranks, prints the errors, and fails where one is above
what BOUNDS states; runs on 128, 512 and 1024 ranks are held out (but that on 512 was seen when the
tail of rounds in space was chosen, and those on 64 to 1024 when ASKS_ALL was).

The machine is assumed; each number is an option:
    --own_call, --border_call   seconds a call: of a tile's own, and one that a message causes
    --undivided, --read         seconds a point: of what each rank does for all points, and of the
                                first rank that reads them
    --told, --loop              seconds a look-up among what a tile was told; for each other rank in
                                a round. Defaults of these six: of a processor at 2 to 3 GHz that
                                others used, too
    --latency, --bandwidth      2 us; 12.5e9 bytes/s (100 Gbit/s): a network as it is sold
    --overhead                  seconds of a processor for a message: 1 us
    --alltoall                  bruck: half of all numbers go in each of log2 P steps; pairwise
    --memory                    bytes of a rank: 4e9 (256 GB for 64 cores)

--design now: each rank has all points and tables for all other tiles; the first rank reads and
    sends all; sizes go by MPI_Alltoall.
    divided: points are divided, tables and sizes are those of neighbours; the first rank reads all.
    read: and each rank reads its part. (In the code tables and sizes are those of all ranks.)
--spread S: uneven input: horizons of a rank are shifted by a normal number of deviation S.

    rounds, horizons, agreements   as they came
    calls           of a rank: mean, most; over_one: mean over those of one rank / P
    steps_over_mean the most calls of a rank in each step, summed, over the mean of all
    messages, bytes of a rank; most_bytes: of one rank in one round
    memory_*        bytes of a rank: of the trace; of points, at the peak; of tables of other ranks
    seconds_*       read, undivided, spread (the first rank sends the points), calls (own, of the
                    slowest), border (calls of messages, and messages), told, agree, sizes
    efficiency      seconds of one rank / P over the seconds; closed_form: seconds by means, nothing
                    drawn and nobody waiting
"""
import argparse
import json
import math
import pathlib
import sys

try:
    import numpy as np
except ImportError:
    print("scale.py: numpy is not installed", file=sys.stderr)
    sys.exit(77)

COUNTS = pathlib.Path(__file__).with_name("scale_counts.json")
RHO = {2: 2 ** 0.5, 3: 2.0}  # a bucket's lengths
NAME = {2: "plane", 3: "space"}

# Laws, by dimension. The side of a tile is in mean spacings.
CALLS = {2: (5.645, 14.0), 3: (5.05, 15.1)}  # of one rank: a n + b n^((d-1)/d)
MESSAGES = {2: (7.86, 24.4), 3: (10.85, 30.2)}  # a unit of a face; of a corner, in space an edge
CALLS_OF_MESSAGE = {2: (1.10, 8.2), 3: (0.985, 0.75)}  # a + b / side
BYTES_OF_MESSAGE = {2: 60.1, 3: 76.0}
SEEN_OF_MESSAGE = {2: 0.43, 3: 0.47}
TOUCHED = {2: (1.59, 2.6), 3: (1.60, 2.6)}  # records, for a point, and for one that is seen
TAIL = {2: 1.7, 3: 1.6}  # rounds in which messages become e times fewer
SCATTER = 1.4  # deviation of calls, over the root of the mean
CLUMPS = 2.0  # variance of messages, over the mean
# Outside the points, in coarse horizons: messages for a side of a tile there, a + b log2 P; how
# many ranks speak, a b^k of the k-th from the last; rounds in which one asks each other one.
HULL = {2: (0.9, 1.15), 3: (22.0, 13.5)}
HULL_SPEAKERS = {2: (4, 1.25), 3: (16, 4.0)}
HULL_LAST = {2: (), 3: (0.1, 0.75)}  # of these messages, in the last horizons; else
HULL_OTHERS = {2: 1.0, 3: 1.2}
ASKS_ALL = {2: 16, 3: 0}

TRACE = {2: 1270.0, 3: 1790.0}  # bytes a point, of one rank
POINT_AT_PEAK = {2: 380.0, 3: 540.0}  # bytes a point, on every rank
TABLE = 264.0  # bytes for each other rank: what it asked and was told, what goes to it

HELD_OUT = (128, 512, 1024)
# The largest relative error of a mean, of rounds, of the most calls summed, of the most bytes.
BOUNDS = {"messages": 0.12, "calls": 0.08, "rounds": 0.35, "steps_calls": 0.15, "most_bytes": 0.45}


class Grid:
    """Ranks in a grid, and what they have in common."""

    def __init__(self, points, ranks, dimension):
        self.dims = self.factors(ranks, dimension)
        self.dimension = dimension
        self.ranks = ranks
        self.sides = [points ** (1 / dimension) / d for d in self.dims]
        at = np.indices(self.dims).reshape(dimension, -1)
        # By direction: who has a neighbour there, and what they have in common: a face, a corner in
        # the plane, an edge in space.
        self.has, self.from_there, self.pairs, self.width = {}, {}, {}, {}
        for axis in range(dimension):
            for step in (-1, 1):
                self.add(at, {axis: step})
        for one in range(dimension):
            for other in range(one):
                for steps in ((-1, -1), (-1, 1), (1, -1), (1, 1)):
                    self.add(at, {one: steps[0], other: steps[1]})
        hull = [(at[a] == 0).astype(int) + (at[a] == self.dims[a] - 1) for a in range(dimension)]
        self.hull_sides = sum(hull)
        self.hull_faces = sum(h * self.common([a]) for a, h in enumerate(hull))
        self.on_hull = np.flatnonzero(self.hull_sides)

    @staticmethod
    def factors(ranks, dimension):
        """Nearly equal; the largest first."""
        if dimension == 1:
            return [ranks]
        target = round(ranks ** (1 / dimension), 9)
        first = next(f for f in range(math.ceil(target), ranks + 1) if ranks % f == 0)
        return [first] + Grid.factors(ranks // first, dimension - 1)

    def common(self, axes):
        return math.prod(s for a, s in enumerate(self.sides) if a not in axes)

    def add(self, at, steps):
        inside = np.ones(self.ranks, bool)
        for axis, step in steps.items():
            inside &= (at[axis] + step >= 0) & (at[axis] + step < self.dims[axis])
        offset = tuple(steps.get(a, 0) for a in range(self.dimension))
        if not inside.any():
            return
        self.has[offset] = inside
        self.from_there[offset] = np.flatnonzero(inside)
        self.pairs[offset] = len(self.from_there[offset])
        self.width[offset] = self.common(list(steps))

    def arrive(self, sent, offset):
        """What each rank gets of what all send in a direction."""
        return np.roll(sent.reshape(self.dims), offset, range(self.dimension)).reshape(-1)

    def target(self, rank, offset):
        at = np.unravel_index(rank, self.dims)
        return np.ravel_multi_index(tuple(a + o for a, o in zip(at, offset)), self.dims)


def tail_shares(slots, fall):
    """Shares of a horizon's messages by round, the largest first; they go on falling."""
    shares = [s for s in slots if s > 2] or [1.0]
    while shares[-1] > 1e-7:
        shares.append(shares[-1] * math.exp(-1 / fall))
    return [s / sum(slots or [1.0]) for s in shares]


def coarse_shares(dimension):
    """Of horizons whose lengths are those of many tiles, outside the points."""
    if dimension == 2:
        fall = [math.exp(-k / 2.4) for k in range(60)]
    else:
        fall = [0.3, 0.26, 0.16, 0.1, 0.07, 0.04, 0.03]
        fall += [0.006 * math.exp(-k / 5.5) for k in range(len(fall), 120)]
    return [f / sum(fall) for f in fall]


class Horizon:
    def __init__(self, kind, share, weight, shares):
        self.kind = kind      # quadtree, core, coarse, last
        self.share = share    # of the calls inside
        self.weight = weight  # of the messages between neighbours
        self.shares = shares  # of its messages, by round


def horizons(points, dimension, counts):
    """Those of a run that was counted; more points have more fine and more coarse ones."""
    base = counts[NAME[dimension]]
    listed = base["horizons"]
    inside = [h for h in listed if h[0] != "coarse"]
    calls = sum(h[1] for h in inside)
    messages = sum(sum(h[2]) for h in inside)
    made = [Horizon(h[0], h[1] / calls, sum(h[2]) / messages, tail_shares(h[2], TAIL[dimension]))
            for h in inside]
    more = math.log(points / base["points"]) / dimension / math.log(RHO[dimension])
    finest = made[1]
    finest.share = made[3].share
    factor = RHO[dimension] ** dimension
    fine = [Horizon("core", finest.share / factor ** k, 0.0, [1.0])
            for k in range(1, round(more) + 1)]
    coarse = sum(h[0] == "coarse" for h in listed) + round(more)
    far = [Horizon("coarse", 0.0, 0.0, coarse_shares(dimension)) for _ in range(max(coarse, 0))]
    first = 1 + max(0, -round(more))
    all_of_them = made[:1] + fine[::-1] + made[first:-1] + far + made[-1:]
    calls = sum(h.share for h in all_of_them)
    for h in all_of_them:
        h.share /= calls
    return all_of_them


class Run:
    """One case."""

    def __init__(self, args, counts):
        self.args = args
        self.d = args.dimension
        self.n = args.points
        self.p = args.ranks
        self.random = np.random.default_rng(args.seed)
        self.grid = Grid(self.n, self.p, self.d)
        self.horizons = horizons(self.n, self.d, counts)
        self.own = self.own_calls()
        a, b = CALLS_OF_MESSAGE[self.d]
        self.per_message = a + b / (self.n / self.p) ** (1 / self.d)
        self.divided = args.design != "now"
        self.calls = np.zeros(self.p)
        self.sent = np.zeros(self.p)
        self.steps = 0.0
        self.rounds = self.agreements = self.held = 0
        self.most_messages = 0.0
        self.seconds = dict.fromkeys(("read", "undivided", "spread", "calls", "border", "told",
                                      "agree", "sizes"), 0.0)
        self.shift = np.rint(self.random.normal(0, args.spread, self.p)).astype(int)

    # --- What a rank has to do

    def own_calls(self):
        """Of each rank: points are divided evenly, the outside belongs to the hull."""
        inside, outside = CALLS[self.d]
        hull = outside * self.n ** ((self.d - 1) / self.d)
        return inside * self.n / self.p + hull * self.grid.hull_faces / self.grid.hull_faces.sum()

    def own_in(self, k):
        """Calls of each rank in a horizon, as drawn."""
        share = np.array([h.share for h in self.horizons])
        shift = self.shift if self.horizons[k].kind == "core" else 0
        if np.ndim(shift) and shift.any():
            core = [i for i, h in enumerate(self.horizons) if h.kind == "core"]
            padded = np.concatenate((np.zeros(64), share[core], np.zeros(64)))
            mean = self.own * padded[np.clip(k - core[0] + 64 + shift, 0, len(padded) - 1)]
        else:
            mean = self.own * share[k]
        drawn = self.random.normal(mean, SCATTER * np.sqrt(mean))
        small = mean < 20
        drawn[small] = self.random.poisson(mean[small])
        return np.maximum(np.rint(drawn), 0)

    def clumped(self, mean, size):
        """As many as messages scatter: with a variance of CLUMPS times the mean."""
        if mean > 100:
            return np.maximum(np.rint(self.random.normal(mean, math.sqrt(CLUMPS * mean), size)), 0)
        return self.random.negative_binomial(mean / (CLUMPS - 1), 1 / CLUMPS, size)

    def between_neighbours(self, weight):
        """Messages that each rank sends and gets."""
        sent, got = np.zeros(self.p), np.zeros(self.p)
        for offset, has in self.grid.has.items():
            kind = 0 if sum(map(abs, offset)) == 1 else 1
            mean = MESSAGES[self.d][kind] * self.grid.width[offset] * weight
            if mean * self.grid.pairs[offset] < 1e-9:
                continue
            if mean * self.p > 2000:
                out = np.where(has, self.clumped(mean, self.p), 0)
                sent += out
                got += self.grid.arrive(out, offset)
            else:  # a few of them
                some = self.random.choice(self.grid.from_there[offset],
                                          self.random.poisson(mean * self.grid.pairs[offset]))
                np.add.at(sent, some, 1)
                np.add.at(got, self.grid.target(some, offset), 1)
        return sent, got

    def on_hull(self, total, speakers):
        """Large simplices outside: a few ranks have them, and ask all around."""
        sent, got = np.zeros(self.p), np.zeros(self.p)
        hull = self.grid.on_hull
        count = self.random.poisson(total)
        some = self.random.choice(hull, min(speakers, len(hull)), replace=False)
        np.add.at(sent, self.random.choice(some, count), 1)
        np.add.at(got, self.random.choice(hull, count), 1)
        return sent, got

    # --- What it costs

    def levels(self):
        return math.ceil(math.log2(self.p)) if self.p > 1 else 0

    def agree(self, times=1):
        self.agreements += times
        self.seconds["agree"] += times * self.levels() * (self.args.latency + self.args.overhead)

    def exchange_sizes(self):
        """How long the messages will be: one number for each pair, or for neighbours."""
        a = self.args
        if self.divided:
            cost = self.levels() * a.latency + 3 ** self.d * a.overhead
        elif a.alltoall == "pairwise":
            cost = (self.p - 1) * a.overhead + a.latency
        else:  # Bruck: half of all numbers go in each of log2 P steps
            cost = self.levels() * (a.latency + a.overhead + 4 * self.p / a.bandwidth)
        if not self.divided:
            cost += a.loop * self.p
        self.seconds["sizes"] += cost

    def run_step(self, calls, kind, each):
        self.calls += calls
        self.steps += calls.max()
        self.seconds[kind] += calls.max() * each

    def hold_round(self, sent, got, to_whom):
        """Ends when the slowest has ended."""
        a = self.args
        self.rounds += 1
        self.agree(2)  # on the next bucket; that there is room
        self.exchange_sizes()
        self.sent += sent
        self.most_messages = max(self.most_messages, sent.max())
        calls = np.rint(got * self.per_message)
        busy = calls * a.border_call + np.minimum(sent + got, to_whom) * a.overhead \
            + (sent + got) * BYTES_OF_MESSAGE[self.d] / a.bandwidth
        self.seconds["border"] += busy.max() + a.latency
        self.calls += calls
        self.steps += calls.max()

    def ask_told(self):
        """Who of all tiles was told of what has been touched."""
        a, b = TOUCHED[self.d]
        touched = a * self.n / self.p + b * SEEN_OF_MESSAGE[self.d] * self.sent.mean()
        self.seconds["told"] += touched * self.args.told

    # --- The run

    def run(self):
        whole = self.n / self.p if self.divided else self.n
        self.seconds["undivided"] = whole * self.args.undivided
        copies = {"now": self.p - 1, "divided": 1 - 1 / self.p, "read": 0}[self.args.design]
        self.seconds["spread"] = self.n * (16 + 8 * self.d) * copies / self.args.bandwidth
        self.seconds["read"] = self.args.read * (whole if self.args.design == "read" else self.n)
        for k, horizon in enumerate(self.horizons):
            self.run_horizon(k, horizon)
        self.ask_told()
        return self.report()

    def run_horizon(self, k, horizon):
        own = self.own_in(k)
        if horizon.kind == "core" and own.max() == 0:
            return  # nobody has anything to run: it is left out
        self.held += horizon.kind not in ("quadtree", "last")
        self.run_step(own, "calls", self.args.own_call)
        self.agree(3)  # which is next; that nothing waits; that there is no fault
        if self.p == 1:
            return
        if horizon.kind == "coarse":
            return self.run_coarse(k, horizon)
        for share in horizon.shares:
            sent, got = self.between_neighbours(horizon.weight * share)
            if sent.any():
                self.hold_round(sent, got, 3 ** self.d - 1)

    def run_coarse(self, k, horizon):
        from_last = sum(h.kind == "coarse" for h in self.horizons[k + 1:])
        a, b = HULL[self.d]
        total = (a + b * math.log2(self.p)) * self.grid.hull_sides.sum()
        last = HULL_LAST[self.d]
        total *= last[from_last] if from_last < len(last) else HULL_OTHERS[self.d]
        some, more = HULL_SPEAKERS[self.d]
        speakers = int(min(self.p, some * more ** min(from_last, 30)))
        for share in horizon.shares:
            sent, got = self.on_hull(total * share, speakers)
            if sent.any():
                self.hold_round(sent, got, self.p)
        if from_last in (4, 8):
            self.ask_all(ASKS_ALL[self.d] // 2)

    def ask_all(self, times):
        """Of a simplex so large that the box around it is all: its rank asks each other one."""
        for time in range(times):
            sent = np.zeros(self.p)
            sent[self.random.choice(self.grid.on_hull)] = (1 + time % 2) * (self.p - 1)
            self.hold_round(sent, np.full(self.p, sent.sum() / self.p), self.p)

    def closed_form(self, seconds):
        """Of the tiles, by means alone: no rank waits for another."""
        a = self.args
        own = CALLS[self.d][0] * self.n / self.p + CALLS[self.d][1] * self.n ** (
            (self.d - 1) / self.d) / self.p
        border = self.sent.mean() * self.per_message * a.border_call
        others = ("read", "undivided", "spread", "told", "agree", "sizes")
        return own * a.own_call + border + self.rounds * a.latency \
            + sum(seconds[k] for k in others)

    def report(self):
        one = CALLS[self.d][0] * self.n + CALLS[self.d][1] * self.n ** ((self.d - 1) / self.d)
        total = sum(self.seconds.values())
        sent = self.sent.mean()
        trace = TRACE[self.d] * self.n / self.p * self.calls.mean() / (one / self.p)
        points = POINT_AT_PEAK[self.d] * (self.n / self.p if self.divided else self.n)
        tables = TABLE * (3 ** self.d if self.divided else self.p)
        seconds_of_one = one * self.args.own_call + self.n * (self.args.undivided + self.args.read)
        figures = {
            "bench": "scale", "dimension": self.d, "points": self.n, "ranks": self.p,
            "design": self.args.design, "spread": self.args.spread,
            "rounds": self.rounds, "horizons": self.held, "agreements": self.agreements,
            "calls": [round(self.calls.mean()), round(self.calls.max())],
            "over_one": round(self.calls.mean() / (one / self.p), 4),
            "steps_over_mean": round(self.steps / self.calls.mean(), 4),
            "messages": round(sent, 1), "bytes": round(sent * BYTES_OF_MESSAGE[self.d]),
            "most_bytes": round(self.most_messages * BYTES_OF_MESSAGE[self.d]),
            "memory_trace": round(trace), "memory_points": round(points),
            "memory_tables": round(tables),
            "memory_fits": bool(trace + points + tables <= self.args.memory),
            **{f"seconds_{k}": round(s, 4) for k, s in self.seconds.items()},
            "seconds": round(total, 3),
            "closed_form": round(self.closed_form(self.seconds), 3),
            "efficiency": round(seconds_of_one / self.p / total, 4)}
        return figures


# --- Against what was measured

def errors(case, made):
    """Relative, by figure."""
    mean = {"messages": case["messages"] / case["ranks"], "calls": case["calls"] / case["ranks"],
            "rounds": case["rounds"], "steps_calls": case["steps_calls"],
            "most_bytes": case["most_bytes"]}
    figure = {"messages": made["messages"], "calls": made["calls"][0], "rounds": made["rounds"],
              "steps_calls": made["steps_over_mean"] * made["calls"][0],
              "most_bytes": made["most_bytes"]}
    return {k: figure[k] / mean[k] - 1 for k in mean if mean[k]}


def check(args, counts):
    """Whether what was measured comes again. Returns: the exit code."""
    worst = {which: dict.fromkeys(BOUNDS, 0.0) for which in ("fitted", "held_out")}
    for case in counts["measured"]:
        if case["family"] != "uniform" or case["ranks"] == 1 or case["n"] < 10000:
            continue
        which = "held_out" if case["ranks"] in HELD_OUT else "fitted"
        args.dimension, args.points, args.ranks = case["dimension"], case["n"], case["ranks"]
        made = errors(case, Run(args, counts).run())
        print(json.dumps({"check": [case["dimension"], case["n"], case["ranks"]], "which": which,
                          **{k: round(e, 3) for k, e in made.items()}}))
        for k, e in made.items():
            worst[which][k] = max(worst[which][k], abs(e))
    failed = [k for k, bound in BOUNDS.items() if max(w[k] for w in worst.values()) > bound]
    print(json.dumps({which: {k: round(e, 3) for k, e in w.items()} for which, w in worst.items()}
                     | {"failed": failed}))
    return 1 if failed else 0


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--dimension", type=int, choices=(2, 3), default=2)
    parser.add_argument("--points", type=float, default=1e6)
    parser.add_argument("--ranks", type=int, nargs="+", default=[64])
    parser.add_argument("--design", choices=("now", "divided", "read"), default="now")
    parser.add_argument("--alltoall", choices=("bruck", "pairwise"), default="bruck")
    parser.add_argument("--spread", type=float, default=0.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--own_call", type=float, help="2.4e-6; in space 7e-6")
    parser.add_argument("--border_call", type=float, help="5e-6; in space 25e-6")
    parser.add_argument("--undivided", type=float, default=3.5e-6)
    parser.add_argument("--read", type=float, default=0.25e-6)
    parser.add_argument("--latency", type=float, default=2e-6)
    parser.add_argument("--bandwidth", type=float, default=12.5e9)
    parser.add_argument("--overhead", type=float, default=1e-6)
    parser.add_argument("--told", type=float, default=6.5e-9)
    parser.add_argument("--loop", type=float, default=25e-9)
    parser.add_argument("--memory", type=float, default=4e9)
    return parser.parse_args()


def with_times(args):
    args.own_call = args.own_call or {2: 2.4e-6, 3: 7e-6}[args.dimension]
    args.border_call = args.border_call or {2: 5e-6, 3: 25e-6}[args.dimension]
    return args


def main():
    args = arguments()
    counts = json.loads(COUNTS.read_text(encoding="utf-8"))
    if args.check:
        return check(with_times(args), counts)
    all_ranks = args.ranks
    with_times(args)
    for ranks in all_ranks:
        args.ranks = ranks
        print(json.dumps(Run(args, counts).run()), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
