#!/usr/bin/env python3
"""Faults put into whole rooms of the program on purpose, one operator each: which of them do the tests notice?

    python3 tests/mutants/rooms/rooms.py FOLDER [--draw 400] [--seed 21] [--jobs 2] [--only NUMBER,...]

Draws mutants at random over the rooms' sources, rewrites a copy of the tree in FOLDER so that the environment variable
CONTCT_MUTANT chooses one of them, and builds that once. Then every test of ctest runs once without a mutant, which
shows what mutants it reaches; and for each mutant the tests that reach it run, its own room's first, until one fails.

Prints by room how many were noticed. Exit status 1 where a mutant survives that survivors.toml has no reason for, or
where that table names one that is noticed or whose line is gone; 2 where the machinery itself fails."""

import argparse
import collections
import concurrent.futures
import hashlib
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import time
import tomllib

here = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, here)
import candidates  # noqa: E402



class Failure(Exception):
    pass


class Settings:
    """What is mutated and how that is built and tested, from a TOML file."""

    def __init__(self, path):
        with open(path, 'rb') as file:
            read = tomllib.load(file)
        beside = os.path.dirname(os.path.abspath(path))
        self.root = os.path.normpath(os.path.join(beside, read['root']))
        self.table = os.path.join(beside, read['table'])
        self.rooms = read['rooms']
        self.libraries, self.targets = read['libraries'], read['targets']
        self.cmake = read['cmake']
        self.tests_left_out = re.compile(read['tests_left_out'])
        self.most_seconds = read['most_seconds']
        self.slack = read['slack_seconds']
        self.programs = read['programs']


def draw_of(settings, seed):
    """All candidates in the order of the draw. A candidate's place depends on itself and the seed alone, so that a
    change of another line draws no others."""
    found = []
    for room in settings.rooms:
        folder = os.path.join(settings.root, 'cpp/contct', room)
        for name in sorted(os.listdir(folder)):
            if name.endswith(('.cpp', '.hpp')):
                path = f'cpp/contct/{room}/{name}'
                with open(os.path.join(settings.root, path), encoding='utf-8') as source:
                    found += candidates.of_source(path, source.read())
    return sorted(found, key=lambda c: hashlib.sha256(repr((seed, c.key())).encode()).hexdigest())


def choose(ordered, count, dropped):
    """The first `count` that can be in one source together and were not dropped, numbered from 1 by their place."""
    chosen, by_path = [], collections.defaultdict(list)
    for number, c in enumerate(ordered, 1):
        if len(chosen) == count:
            break
        others = by_path[c.path]
        if number in dropped or any(o.site == c.site or candidates.crosses(o, c) or (o.begin, o.end) == (c.begin, c.end) for o in others):
            continue
        others.append(c)
        chosen.append((number, c))
    return chosen


def copy_tree(root, tree):
    """The files of the tree as they are, without what is built in it."""
    paths = []
    for folder, folders, files in os.walk(root):
        folders[:] = [f for f in folders if f not in ('.git', 'build', '__pycache__') and os.path.join(folder, f) != tree]
        paths += [os.path.relpath(os.path.join(folder, name), root) for name in files]
    for path in paths:
        source, copy = os.path.join(root, path), os.path.join(tree, path)
        if os.path.isfile(source) and not same(source, copy):
            os.makedirs(os.path.dirname(copy), exist_ok=True)
            shutil.copyfile(source, copy)
            shutil.copymode(source, copy)


def same(one, other):
    if not os.path.isfile(other) or os.path.getsize(one) != os.path.getsize(other):
        return False
    with open(one, 'rb') as a, open(other, 'rb') as b:
        return a.read() == b.read()


def write_if_other(path, text):
    if os.path.isfile(path):
        with open(path, encoding='utf-8') as old:
            if old.read() == text:
                return
    with open(path, 'w', encoding='utf-8') as file:
        file.write(text)


def rewrite_tree(settings, tree, chosen):
    shutil.copyfile(os.path.join(here, 'mutant_is.hpp'), os.path.join(tree, 'cpp/contct/mutant_is.hpp'))
    by_path = collections.defaultdict(list)
    for number, c in chosen:
        by_path[c.path].append((number, c))
    for room in settings.rooms:
        for name in os.listdir(os.path.join(settings.root, 'cpp/contct', room)):
            path = f'cpp/contct/{room}/{name}'
            if name.endswith(('.cpp', '.hpp')):
                with open(os.path.join(settings.root, path), encoding='utf-8') as source:
                    text = source.read()
                write_if_other(os.path.join(tree, path), candidates.rewrite(text, by_path[path]) if path in by_path else text)


def configure(tree, build, more):
    if os.path.isfile(os.path.join(build, 'build.ninja')):
        return
    # Where a mutant lets a [[noreturn]] function return, the compiler would drop the mutant: there it traps.
    unreachable = '-fsanitize=unreachable -fsanitize-undefined-trap-on-error'
    command = ['cmake', '-S', tree, '-B', build, '-G', 'Ninja', '-DCMAKE_BUILD_TYPE=Release',
               f'-DCMAKE_CXX_FLAGS=-w -Wno-narrowing {unreachable}', '-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG', *more]
    if shutil.which('ccache'):
        command += ['-DCMAKE_CXX_COMPILER_LAUNCHER=ccache']
    run_quietly(command)


def run_quietly(command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode != 0:
        raise Failure(f'{" ".join(command)}: exit status {done.returncode}\n{done.stdout[-3000:]}')


LOCATION = re.compile(r'(cpp/contct/[a-z]+/\w+\.[ch]pp):(\d+)')


def to_drop(output, chosen):
    """The mutants that do not compile, by the lines that the compiler's errors name."""
    by_path = collections.defaultdict(list)
    for number, c in chosen:
        by_path[c.path].append((number, c))

    def at(text):
        return {number for path, line in LOCATION.findall(text) for number, c in by_path[path]
                if c.first_line <= int(line) <= c.last_line}

    dropped, unexplained = set(), ''
    blocks = re.split(r'(?m)^(?=\S[^\n]*\berror: )', output)
    for before, block in zip(blocks, blocks[1:]):
        found = at(block.split('\n', 1)[0]) or at('\n'.join(before.split('\n')[-12:])) or at(block)
        if not found:
            unexplained += block[:600]
        dropped |= found
    return dropped, unexplained


def build_of(folder):
    """Where the preset builds, so that the program finds reference/ as it does there."""
    return os.path.join(folder, 'tree/build/release')


def build_all(settings, folder, ordered, count, jobs):
    """Rewrites and compiles until every chosen mutant compiles; gives these."""
    tree, build = os.path.join(folder, 'tree'), build_of(folder)
    kept = os.path.join(folder, 'dropped.json')
    dropped = set()
    copy_tree(settings.root, tree)
    if os.path.isfile(kept):
        with open(kept, encoding='utf-8') as file:
            known = json.load(file)
        dropped = {n for n, c in enumerate(ordered, 1) if list(c.key()) in known}
    for attempt in range(40):
        chosen = choose(ordered, count, dropped)
        rewrite_tree(settings, tree, chosen)
        configure(tree, build, settings.cmake)
        for targets in (settings.libraries, settings.targets):  # where the libraries fail, no test waits for them
            done = subprocess.run(['ninja', '-C', build, '-k', '0', '-j', str(jobs), *targets], stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True, check=False)
            if done.returncode != 0:
                break
        if done.returncode == 0:
            return chosen, len(dropped)
        found, unexplained = to_drop(done.stdout, chosen)
        print(f'build {attempt + 1}: {len(found)} of {len(chosen)} mutants do not compile', flush=True)
        if not found:
            raise Failure('the mutated tree does not build:\n' + (unexplained or done.stdout[-3000:]))
        dropped |= found
        with open(kept, 'w', encoding='utf-8') as file:
            json.dump([list(c.key()) for n, c in enumerate(ordered, 1) if n in dropped], file)
    raise Failure('the mutated tree does not build after 40 attempts')


class Test:
    def __init__(self, entry):
        self.name = entry['name']
        self.command = entry.get('command')
        properties = {p['name']: p['value'] for p in entry.get('properties', [])}
        self.folder = properties.get('WORKING_DIRECTORY')
        self.environment = dict(e.split('=', 1) for e in properties.get('ENVIRONMENT', []))
        self.usable = bool(self.command) and os.path.exists(self.command[0]) and not any(
            properties.get(k) for k in ('DISABLED', 'WILL_FAIL', 'PASS_REGULAR_EXPRESSION', 'SKIP_REGULAR_EXPRESSION'))
        self.room = self.name.split('/')[0]
        self.seconds, self.reaches = 0.0, set()  # processor time without a mutant; what it reaches then

    def fingerprint(self, programs):
        """Changes when what the test runs was built or edited."""
        files = [a for a in self.command if os.path.isfile(a)] + programs
        return hashlib.sha256(repr([(f, os.stat(f).st_mtime_ns, os.stat(f).st_size) for f in files]).encode()).hexdigest()

    def run(self, mutant=0, reached='', cpu_limit=600.0, wall_limit=3600.0):
        """What came of it, '' when it passed; and the processor time that it took. A process that takes more of that than
        allowed has come to nothing, which does not depend on what else runs; so has one that waits for ever."""
        environment = {**os.environ, **self.environment, 'CONTCT_MUTANT': str(mutant)}
        if reached:
            environment['CONTCT_MUTANTS_REACHED'] = reached

        def limit():
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 30, 1 << 30))
            resource.setrlimit(resource.RLIMIT_AS, (6 << 30, 6 << 30))
            seconds = int(cpu_limit) + 1
            resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))

        started = time.monotonic()
        child = subprocess.Popen(self.command, cwd=self.folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                 stderr=subprocess.DEVNULL, start_new_session=True, preexec_fn=limit)
        waited = False
        while True:
            pid, status, used = os.wait4(child.pid, os.WNOHANG)
            if pid != 0:
                break
            if not waited and time.monotonic() - started > wall_limit:
                waited = True
                os.killpg(child.pid, signal.SIGKILL)
            time.sleep(0.005)
        child.returncode = os.waitstatus_to_exitcode(status)
        try:
            os.killpg(child.pid, signal.SIGKILL)  # what it has left behind
        except ProcessLookupError:
            pass
        came = 'time' if waited or child.returncode == -signal.SIGXCPU else str(child.returncode)
        return '' if child.returncode == 0 else came, used.ru_utime + used.ru_stime


def tests_of(build, left_out):
    listed = subprocess.run(['ctest', '--test-dir', build, '--show-only=json-v1'], check=True, capture_output=True, text=True).stdout
    return [t for t in map(Test, json.loads(listed)['tests']) if t.usable and not left_out.match(t.name)]


def try_without(tests, folder, jobs, programs):
    """Runs every test once without a mutant: its time, and what it reaches; those that have not changed since they last
    ran are known. Gives those that pass."""
    path = os.path.join(folder, 'reached.json')
    known = {}
    if os.path.isfile(path):
        with open(path, encoding='utf-8') as file:
            known = json.load(file)

    def once(numbered):
        number, test = numbered
        fingerprint = test.fingerprint(programs)
        kept = known.get(test.name)
        if kept and kept['fingerprint'] == fingerprint:
            test.seconds, test.reaches = kept['seconds'], set(kept['reaches'])
            return kept['came']
        shared = os.path.join(folder, f'reached.{number}')
        with open(shared, 'wb') as file:
            file.truncate(65536)
        came, test.seconds = test.run(reached=shared)
        with open(shared, 'rb') as file:
            test.reaches = {n for n, byte in enumerate(file.read()) if byte}
        os.remove(shared)
        known[test.name] = {'fingerprint': fingerprint, 'seconds': test.seconds, 'reaches': sorted(test.reaches), 'came': came}
        return came

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        results = list(pool.map(once, enumerate(tests)))
    with open(path, 'w', encoding='utf-8') as file:
        json.dump(known, file)
    for test, came in zip(tests, results):
        if came:
            print(f'left out, since it fails without a mutant ({came}): {test.name}', flush=True)
    return [t for t, came in zip(tests, results) if not came]


def judge(number, c, tests, settings):
    """Which test notices the mutant, '' for none."""
    room = c.path.split('/')[2]
    reaching = sorted((t for t in tests if number in t.reaches), key=lambda t: (t.room != room, t.seconds))
    spent, ran = 0.0, 0
    for test in reaching:
        if spent + test.seconds > settings.most_seconds:
            continue
        came, seconds = test.run(mutant=number, cpu_limit=settings.slack + 5.0 * test.seconds,
                                 wall_limit=60.0 + 30.0 * test.seconds)
        spent, ran = spent + seconds, ran + 1
        if came:
            return {'noticed_by': test.name, 'how': came, 'ran': ran, 'reached_by': len(reaching)}
    return {'noticed_by': '', 'how': '', 'ran': ran, 'reached_by': len(reaching)}


def read_table(settings):
    path, root = settings.table, settings.root
    with open(path, 'rb') as file:
        entries = tomllib.load(file).get('survivor', [])
    table = {}
    for e in entries:
        key = (e['file'], e['line'], e['was'], e['becomes'], e.get('nth', 1), e.get('occurrence', 1))
        if not e.get('reason', '').strip():
            raise Failure(f'{path}: found no reason for {key}')
        with open(os.path.join(root, e['file']), encoding='utf-8') as source:
            if key not in {c.key() for c in candidates.of_source(e['file'], source.read())}:
                raise Failure(f'{path}: found no such mutant in {e["file"]}: {key}')
        table[key] = e['reason']
    return table


def report(results, table, settings):
    """Prints what came of the mutants; gives the exit status."""
    counts = collections.defaultdict(collections.Counter)
    wrong = []
    for number, c, came in results:
        where = f'{number} {c.path}:{c.line}: {c.was} -> {c.becomes} (no. {c.nth} of the line)'
        what = 'noticed' if came['noticed_by'] else 'equivalent' if c.key() in table else 'survive'
        for row in (c.path.split('/')[2], 'all'):
            counts[row]['drawn'] += 1
            counts[row][what] += 1
        if what == 'noticed' and c.key() in table:
            wrong.append(f'{where}: the table says that nothing can notice it; "{came["noticed_by"]}" does')
        if what == 'survive':
            wrong.append(f'{where}: survives {came["ran"]} of {came["reached_by"]} tests that reach it: {c.text}')
    columns = ['drawn', 'noticed', 'equivalent', 'survive']
    print(f'{"room":12}' + ''.join(f'{name:>12}' for name in columns) + f'{"noticed, %":>12}')
    for row in [*settings.rooms, 'all']:
        c = counts[row]
        share = f'{100 * c["noticed"] / max(c["drawn"] - c["equivalent"], 1):12.1f}'  # of those that can be noticed
        print(f'{row:12}' + ''.join(f'{c[name]:12}' for name in columns) + share)
    print('\n'.join(wrong))
    return 1 if wrong else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
    parser.add_argument('folder', help='for the copy of the tree and its build; what is there is used again')
    parser.add_argument('--settings', default=os.path.join(here, 'settings.toml'))
    parser.add_argument('--draw', type=int, default=400)
    parser.add_argument('--seed', type=int, default=21)
    parser.add_argument('--jobs', type=int, default=os.cpu_count())
    parser.add_argument('--only', default='', help='numbers of mutants; all tests run on them, however slow')
    parser.add_argument('--list', action='store_true', help='print the candidates that are drawn, and do nothing')
    options = parser.parse_args()
    settings = Settings(options.settings)
    table = read_table(settings)
    ordered = draw_of(settings, options.seed)
    if options.list:
        for number, c in choose(ordered, options.draw, set()):
            print(f'{number} {c.path}:{c.line}: {c.was} -> {c.becomes}: {c.text}')
        return 0
    os.makedirs(options.folder, exist_ok=True)
    folder = os.path.abspath(options.folder)
    started = time.monotonic()
    chosen, dropped = build_all(settings, folder, ordered, options.draw, options.jobs)
    print(f'{len(ordered)} candidates; {len(chosen)} drawn with seed {options.seed}; {dropped} that do not compile were replaced; '
          f'{time.monotonic() - started:.0f} s', flush=True)
    build = build_of(folder)
    programs = [os.path.join(build, p) for p in settings.programs]
    tests = try_without(tests_of(build, settings.tests_left_out), folder, options.jobs, programs)
    print(f'{len(tests)} tests, {sum(t.seconds for t in tests):.0f} s', flush=True)
    if options.only:
        wanted = {int(n) for n in options.only.split(',')}
        chosen = [(n, c) for n, c in chosen if n in wanted]
    with open(os.path.join(folder, 'log'), 'w', encoding='utf-8') as log:
        def one(pair):
            came = judge(*pair, tests, settings)
            number, c = pair
            log.write(f'{number}\t{c.path}:{c.line}\t{c.was} -> {c.becomes}\t{came}\n')
            log.flush()
            return (number, c, came)
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            results = list(pool.map(one, chosen))
    print(f'{time.monotonic() - started:.0f} s')
    return report(results, table, settings)


if __name__ == '__main__':
    try:
        sys.exit(main())
    except Failure as failure:
        print(f'rooms.py: {failure}', file=sys.stderr)
        sys.exit(2)
