from collections.abc import Mapping, Sequence

class FieldDescriptor:
    TYPE_BOOL: int
    TYPE_BYTES: int
    TYPE_DOUBLE: int
    TYPE_FLOAT: int
    TYPE_MESSAGE: int
    TYPE_STRING: int
    name: str
    number: int
    type: int
    message_type: Descriptor

class OneofDescriptor:
    fields: Sequence[FieldDescriptor]

class Descriptor:
    name: str
    full_name: str
    fields: Sequence[FieldDescriptor]
    fields_by_name: Mapping[str, FieldDescriptor]
    oneofs_by_name: Mapping[str, OneofDescriptor]

class EnumDescriptor: ...
class FileDescriptor: ...
