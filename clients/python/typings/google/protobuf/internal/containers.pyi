from abc import ABCMeta
from collections.abc import Callable, MutableMapping, MutableSequence
from typing import TypeVar

T = TypeVar("T")
K = TypeVar("K")

class RepeatedScalarFieldContainer(MutableSequence[T], metaclass=ABCMeta): ...

class RepeatedCompositeFieldContainer(MutableSequence[T], metaclass=ABCMeta):
    add: Callable[..., T]

class ScalarMap(MutableMapping[K, T], metaclass=ABCMeta): ...
