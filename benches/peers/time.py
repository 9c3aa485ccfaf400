"""Times the programs of `benches/eval.rs` in numpy and Operon; see benches/README.md.

Reads `set<TAB>operations<TAB>postfix` lines from standard input. One thread, 4096 samples,
single precision; prints the best of five passes over all programs of a set.
"""
import sys
import time

import numpy as np

SAMPLES = 4096
BINARY = {"add": np.add, "sub": np.subtract, "mul": np.multiply, "div": np.divide,
          "min": np.minimum, "max": np.maximum}
UNARY = {"sqrt": np.sqrt, "exp2": np.exp2, "log2": np.log2}


def read_sets(lines):
    sets = {}
    for line in lines:
        name, operations, postfix = line.rstrip("\n").split("\t")
        sets.setdefault(name, []).append((int(operations), postfix.split()))
    return sets


def numpy_evaluate(words, columns):
    stack = []
    for word in words:
        if word in BINARY:
            b, a = stack.pop(), stack.pop()
            stack.append(BINARY[word](a, b))
        elif word in UNARY:
            stack.append(UNARY[word](stack.pop()))
        elif word.startswith("x"):
            stack.append(columns[int(word[1:])])
        else:
            stack.append(np.float32(word))
    return stack[0]


def best(programs, evaluate):
    """Seconds for all programs."""
    fastest = float("inf")
    for _ in range(5):
        begin = time.perf_counter()
        for program in programs:
            evaluate(program)
        fastest = min(fastest, time.perf_counter() - begin)
    return fastest


def infix(words):
    """A formula for Operon's parser; exp and log stand for exp2 and log2, which it lacks."""
    symbols = {"add": "+", "sub": "-", "mul": "*", "div": "/"}
    names = {"exp2": "exp", "log2": "log", "sqrt": "sqrt"}
    stack = []
    for word in words:
        if word in symbols:
            b, a = stack.pop(), stack.pop()
            stack.append(f"({a} {symbols[word]} {b})")
        elif word in names:
            stack.append(f"{names[word]}({stack.pop()})")
        else:
            stack.append(word)
    return stack[0]


def operon_evaluator(programs, columns):
    import pyoperon as operon

    table = np.asfortranarray(np.stack(columns + [columns[0]], axis=1).astype(np.float32))
    dataset = operon.Dataset(table)
    hashes = {f"x{i}": variable.Hash for i, variable in enumerate(dataset.Variables[: len(columns)])}
    trees = [operon.InfixParser.Parse(infix(words), hashes) for _, words in programs]
    rows = operon.Range(0, SAMPLES)
    dispatch = operon.DispatchTable()
    return trees, lambda tree: operon.Evaluate(dispatch, tree, dataset, rows)


def main():
    generator = np.random.default_rng(1)
    columns = [generator.uniform(0.05, 1, SAMPLES).astype(np.float32) for _ in range(3)]
    for name, programs in read_sets(sys.stdin).items():
        work = sum(operations for operations, _ in programs) * SAMPLES * 1e-9
        with np.errstate(all="ignore"):
            seconds = best([words for _, words in programs], lambda words: numpy_evaluate(words, columns))
        print(f"{name}/numpy\t{work / seconds:.3f} G op-evaluations/s")
        # Its parser knows no min and max.
        known = [(count, words) for count, words in programs if not {"min", "max"} & set(words)]
        work = sum(operations for operations, _ in known) * SAMPLES * 1e-9
        try:
            trees, evaluate = operon_evaluator(known, columns)
        except ImportError as reason:
            print(f"{name}/operon\tnot timed: {reason}")
            continue
        speed = work / best(trees, evaluate)
        print(f"{name}/operon\t{speed:.3f} G op-evaluations/s, {len(known)} of {len(programs)} programs")


if __name__ == "__main__":
    main()
