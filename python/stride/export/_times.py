"""Simulated time: exact decimals of seconds in the results, picoseconds here, nanoseconds in MCAP."""

from __future__ import annotations

from datetime import datetime, timedelta, timezone
from decimal import Decimal, InvalidOperation
from typing import Any

PICOSECONDS = 10**12

_BEGIN = datetime(1970, 1, 1, tzinfo=timezone.utc)


def picoseconds(text: str) -> int:
    """Of "14.200358702064". Raises ValueError."""
    whole, _, fraction = text.partition(".")
    if whole.isdigit() and len(fraction) <= 12 and (fraction.isdigit() or not fraction):
        return int(whole) * PICOSECONDS + int(fraction.ljust(12, "0"))
    try:
        return round(Decimal(text) * PICOSECONDS)
    except (InvalidOperation, OverflowError) as error:
        raise ValueError(f"'{text}' is no time") from error


def picoseconds_of(seconds: float) -> int:
    """Of a number of run.json, which has the digits that were written there."""
    return picoseconds(repr(float(seconds)))


def nanoseconds(time: int) -> int:
    """The nearest one."""
    return (time + 500) // 1000


def since_1970(date: datetime) -> int:
    """[ns]; a date without a zone is one of UTC."""
    if date.tzinfo is None:
        date = date.replace(tzinfo=timezone.utc)
    return (date - _BEGIN) // timedelta(microseconds=1) * 1000


def date_of(text: str) -> datetime:
    """Of ISO 8601, "2026-11-27T04:09:51Z". Raises ValueError."""
    return datetime.fromisoformat(text[:-1] + "+00:00" if text.endswith(("Z", "z")) else text)


def seconds(time: int) -> str:
    """As the results have them: without trailing zeros."""
    sign, time = ("-", -time) if time < 0 else ("", time)
    return f"{sign}{time // PICOSECONDS}.{time % PICOSECONDS:012}".rstrip("0").rstrip(".")


def timestamp(kind: Any, time: int) -> Any:
    """Of protobuf, from nanoseconds."""
    return kind(seconds=time // 10**9, nanos=time % 10**9)
