from datetime import datetime, tzinfo

from google.protobuf.message import Message

class Timestamp(Message):
    seconds: int
    nanos: int
    def ToDatetime(self, tzinfo: tzinfo | None = None) -> datetime: ...
