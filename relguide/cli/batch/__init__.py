"""`relguide plan --batch`: a file of situations to a file of answers, chunk by chunk.

`order.py` says what is asked, `source.py` cuts the file into chunks of whole lines, `work.py`
answers a chunk wherever it is sent, `part.py` keeps what is answered so that a stopped run can go
on, `run.py` has it done by many.
"""
