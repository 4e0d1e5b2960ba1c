from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from pt._enums import Result
from pt.farm._identity import LAST, WORTH_ANOTHER_WORKER, Identity
from pt.farm._options import FarmError, Progress
from pt.farm._task import Outcome, codecs, introduce
from pt.farm._workers import Done, Member, Try, addresses, now, submit

MOST_FAILURES = 3
LOOK_SECONDS = 0.25


class Crew:
    def __init__(self, client: Any, packed: bytes, done: Done, progress: Progress, identity: Identity | None, *,
                 mixed: bool, patience: float) -> None:
        self._client, self._packed, self._done, self._progress = client, packed, done, progress
        self.identity, self._goes_on = identity, identity is not None
        self._mixed, self._patience = mixed, patience
        self._members: dict[str, Member] = {}
        self._looked = -LOOK_SECONDS
        self._worker_time = now()

    def __iter__(self) -> Iterator[Member]:
        return iter(self._members.values())

    def _count(self) -> int:
        self._progress.workers = sum(member.identity is not None and not member.is_banned for member in self)
        return self._progress.workers

    @property
    def is_there(self) -> bool:
        return any(member.identity for member in self)

    def look(self) -> list[tuple[str, Try]]:
        """Returns addresses and tries of workers that have left. Raises FarmError without workers."""
        if now() - self._looked < LOOK_SECONDS:
            return []
        try:
            there = addresses(self._client)
        except Exception as error:
            raise FarmError(f"the scheduler is lost: {type(error).__name__}: {error}",
                            Result.ERROR_DEVICE_LOST) from error
        self._looked = now()
        for address in there - set(self._members):
            member = self._members[address] = Member(address, now())
            member.introduction = submit(self._client, address, self._done, introduce, self._packed, codecs())
        lost = [(address, each) for address in set(self._members) - there
                for each in self._members.pop(address).tries.values()]
        usable = [member for member in self if not member.is_banned]
        if self._members and not usable:
            raise FarmError("every worker has failed or was refused: " + "; ".join(self._progress.messages[-4:]),
                            self._progress.last_result)
        if self._count():
            self._worker_time = now()
        elif now() - self._worker_time > self._patience:
            raise FarmError(f"no worker is ready after {self._patience:g} s; the scheduler has {len(self._members)}",
                            Result.ERROR_NO_DEVICE)
        return lost

    def of_introduction(self, future: Any) -> Member | None:
        return next((member for member in self if member.introduction is not None
                     and member.introduction.key == future.key), None)

    def of_part(self, future: Any) -> Member | None:
        return next((member for member in self if future.key in member.tries), None)

    def meet(self, member: Member, outcome: Outcome | None, identity: Identity | None) -> None:
        member.introduction = None
        if outcome is None:
            member.is_banned = True
        elif identity is None:
            self.blame(member, outcome, most=1)
        else:
            member.is_cpu = outcome.is_cpu
            self._compare(member, identity)

    def blame(self, member: Member, outcome: Outcome, most: int = MOST_FAILURES) -> None:
        self._progress.failed += 1
        self._progress.last_result = outcome.result
        if not outcome.may_help_elsewhere:
            raise FarmError(outcome.error, outcome.result, outcome.broken_rules)
        member.failures += 1
        member.is_banned = member.failures >= most
        word = " is refused" if member.failures == most else ""
        self._progress.messages.append(f"worker {member.address}{word}: {outcome.error}")

    def _compare(self, member: Member, identity: Identity) -> None:
        if self.identity is None:
            self.identity = identity
        differences = identity.differences(self.identity, (LAST,) if self._mixed else ())
        others = [name for name in differences if name not in WORTH_ANOTHER_WORKER]
        if others and self._goes_on:
            raise FarmError(f"the checkpoint belongs to another picture: its {', '.join(others)} differs",
                            Result.ERROR_INCOMPATIBLE)
        if differences == [LAST]:
            models, theirs = (" and ".join(sorted(each.models)) for each in (identity, self.identity))
            self._ban(member, f"it has {models}, and the others {theirs}: the sum of their films would not have the bits of "
                              "one device (mixed allows it)")
        elif differences:
            self._ban(member, f"its films would differ from the others in {', '.join(differences)}")
        else:
            member.identity = identity
            self._count()

    def _ban(self, member: Member, reason: str) -> None:
        member.is_banned = True
        self._progress.messages.append(f"worker {member.address} is refused: {reason}")
