"""Clusters: Dask, Ray, and executors of processes, behind one small interface."""

from __future__ import annotations

import concurrent.futures
import os
from collections.abc import Callable
from typing import Any, Protocol

from quasirigid._errors import InputError

__all__: list[str] = []

Task = Callable[[list[int]], bytes]


class Workers(Protocol):
    """Workers of a cluster, and the tasks that they have."""

    count: int

    def submit(self, task: Task, rows: list[int]) -> None:
        """Hands a task on."""

    def wait(self) -> list[bytes]:
        """Results of at least one task; raises what a task raised."""

    def cancel(self) -> None:
        """Drops the tasks that nobody waits for any more."""


class _Executor:
    """Executor of ``concurrent.futures``."""

    def __init__(self, executor: concurrent.futures.Executor) -> None:
        self._executor = executor
        self.count: int = getattr(executor, "_max_workers", None) or os.cpu_count() or 1
        self._tasks: set[concurrent.futures.Future[bytes]] = set()

    def submit(self, task: Task, rows: list[int]) -> None:
        self._tasks.add(self._executor.submit(task, rows))

    def wait(self) -> list[bytes]:
        first = concurrent.futures.FIRST_COMPLETED
        done, self._tasks = concurrent.futures.wait(self._tasks, return_when=first)
        return [task.result() for task in done]

    def cancel(self) -> None:
        for task in self._tasks:
            task.cancel()


class _Dask:
    """Client of ``distributed``."""

    def __init__(self, client: Any) -> None:
        self._client = client
        threads = client.nthreads().values()
        if not threads:
            raise InputError("client: the cluster has no workers; start some, or wait for them with client.wait_for_workers(1)")
        self.count = sum(threads)
        self._tasks: set[Any] = set()

    def submit(self, task: Task, rows: list[int]) -> None:
        # A task is not named after its arguments: those of an earlier call, after a change of a file, are not its own.
        self._tasks.add(self._client.submit(task, rows, pure=False))

    def wait(self) -> list[bytes]:
        import distributed

        wait: Any = distributed.wait
        done, rest = wait(self._tasks, return_when="FIRST_COMPLETED")
        self._tasks = set(rest)
        return [task.result() for task in done]

    def cancel(self) -> None:
        self._client.cancel(list(self._tasks))


class _Ray:
    """The module ``ray``."""

    def __init__(self, ray: Any) -> None:
        self._ray = ray
        if not ray.is_initialized():
            ray.init()
        self.count = max(1, int(ray.cluster_resources().get("CPU", 1)))
        self._tasks: list[Any] = []
        # a worker that is lost is no failure of the task
        self._run = ray.remote(_run).options(max_retries=-1)

    def submit(self, task: Task, rows: list[int]) -> None:
        self._tasks.append(self._run.remote(task, rows))

    def wait(self) -> list[bytes]:
        done, self._tasks = self._ray.wait(self._tasks)
        results: list[bytes] = self._ray.get(done)
        return results

    def cancel(self) -> None:
        for task in self._tasks:
            self._ray.cancel(task)


def _run(task: Task, rows: list[int]) -> bytes:
    return task(rows)


def cluster(client: Any) -> Workers:
    """The workers behind a client, by what it is."""
    if isinstance(client, concurrent.futures.Executor):
        return _Executor(client)
    if getattr(client, "__name__", None) == "ray":
        return _Ray(client)
    if type(client).__module__.split(".")[0] == "distributed" and hasattr(client, "nthreads"):
        if getattr(client, "asynchronous", False):
            raise InputError("client: an asynchronous client of Dask is not supported; make it with asynchronous=False")
        return _Dask(client)
    raise InputError(
        f"client = {client!r}: give a distributed.Client, the module ray, or an executor of concurrent.futures"
    )
